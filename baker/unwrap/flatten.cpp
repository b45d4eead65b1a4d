// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/flatten.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace surimi {
namespace {

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
    const auto is_less = [](const Vec2& a, const Vec2& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
    std::sort(points.begin(), points.end(), is_less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Vec2> hull;
    const auto add_side = [&](auto begin, auto end) {
        const size_t start = hull.size();
        for (auto p = begin; p != end; ++p) {
            while (hull.size() >= start + 2 && doubled_area(hull[hull.size() - 2], hull.back(), *p) <= 0)
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();  // the other side begins with it
    };
    add_side(points.begin(), points.end());
    add_side(points.rbegin(), points.rend());
    return hull;
}

Vec2 turn_into(const Vec2& p, const Vec2& axis) {
    return {glm::dot(p, axis), axis.x * p.y - axis.y * p.x};
}

/// Direction of the hull edge on which the box of least area stands.
Vec2 tightest_axis(const std::vector<Vec2>& hull) {
    Vec2 best{1, 0};
    double least = INFINITY;
    // A round hull of thousands of corners has no direction worth a quadratic search.
    const size_t step = std::max<size_t>(1, hull.size() / 256);
    for (size_t i = 0; i < hull.size(); i += step) {
        const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const double length = glm::length(edge);
        if (!(length > 0)) continue;
        Vec2 low{INFINITY};
        Vec2 high{-INFINITY};
        for (const Vec2& p : hull) {
            const Vec2 q = turn_into(p, edge / length);
            low = glm::min(low, q);
            high = glm::max(high, q);
        }
        const double area = (high.x - low.x) * (high.y - low.y);
        // Nearly equal boxes: the first stays, so that rounding does not choose.
        if (area < least * (1 - 1e-9)) {
            least = area;
            best = edge / length;
        }
    }
    return best;
}

void turn_into_tightest_box(FlatChart& chart) {
    const Vec2 axis = tightest_axis(convex_hull(chart.points));
    Vec2 low{INFINITY};
    Vec2 high{-INFINITY};
    for (Vec2& p : chart.points) {
        p = turn_into(p, axis);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (Vec2& p : chart.points) p -= low;
    chart.extent = high - low;
}

Vec3 centroid(const FaceGraph& graph, uint32_t face) {
    const auto& c = graph.corners[face];
    return (graph.positions[c[0]] + graph.positions[c[1]] + graph.positions[c[2]]) / 3.0;
}

std::unordered_map<uint32_t, uint32_t> number_faces(const std::vector<uint32_t>& faces) {
    std::unordered_map<uint32_t, uint32_t> number;
    number.reserve(faces.size());
    for (uint32_t i = 0; i < faces.size(); ++i) number.emplace(faces[i], i);
    return number;
}

}  // namespace

FlatChart flatten(const FaceGraph& graph, std::vector<uint32_t> faces) {
    FlatChart chart;
    Vec3 sum(0);
    std::vector<uint32_t> places;
    for (const uint32_t f : faces) {
        sum += graph.areas[f] * graph.normals[f];
        chart.area += graph.areas[f];
        places.insert(places.end(), graph.corners[f].begin(), graph.corners[f].end());
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());

    const Vec3 axis = normalize_or(sum, graph.normals[faces[0]]);
    const Vec3 helper = std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = normalize_or(glm::cross(helper, axis), Vec3(1, 0, 0));
    const Vec3 v = glm::cross(axis, u);  // u, v, axis are right-handed: fronts stay counter-clockwise
    const Vec3 origin = graph.positions[places[0]];
    for (const uint32_t place : places) {
        const Vec3 p = graph.positions[place] - origin;
        chart.points.emplace_back(glm::dot(p, u), glm::dot(p, v));
    }
    for (const uint32_t f : faces) {
        std::array<uint32_t, 3> t{};
        for (size_t k = 0; k < 3; ++k) {
            const auto at = std::lower_bound(places.begin(), places.end(), graph.corners[f][k]);
            t[k] = static_cast<uint32_t>(at - places.begin());
        }
        chart.triangles.push_back(t);
        chart.flat_area += 0.5 * doubled_area(chart.points[t[0]], chart.points[t[1]], chart.points[t[2]]);
    }
    chart.faces = std::move(faces);
    turn_into_tightest_box(chart);
    return chart;
}

FlatChart make_sliver(uint32_t face) {
    FlatChart chart;
    chart.faces = {face};
    chart.is_sliver = true;
    return chart;
}

std::vector<FlatTriangle> rounded_triangles(const FlatChart& chart, double size) {
    const double longer = std::max(chart.extent.x, chart.extent.y);
    const double scale = longer > 0 ? size / longer : 0;
    std::vector<FlatTriangle> result;
    result.reserve(chart.triangles.size());
    for (const auto& t : chart.triangles) {
        FlatTriangle flat;
        for (size_t k = 0; k < 3; ++k) flat[k] = glm::round(chart.points[t[k]] * scale);
        result.push_back(flat);
    }
    return result;
}

std::array<std::vector<uint32_t>, 2> split_between(const FaceGraph& graph, const std::vector<uint32_t>& faces,
                                                   std::array<uint32_t, 2> seeds) {
    const auto number = number_faces(faces);
    using Step = std::tuple<double, uint32_t, uint32_t>;  // distance, face (number), side
    std::priority_queue<Step, std::vector<Step>, std::greater<>> queue;
    constexpr uint32_t no_side = 2;
    std::vector<uint32_t> side(faces.size(), no_side);
    for (uint32_t s = 0; s < 2; ++s) queue.emplace(0.0, seeds[s], s);
    while (!queue.empty()) {
        const auto [distance, i, s] = queue.top();
        queue.pop();
        if (side[i] != no_side) continue;
        side[i] = s;
        for (const uint32_t beyond : graph.neighbours[faces[i]]) {
            const auto it = number.find(beyond);
            if (it == number.end() || side[it->second] != no_side) continue;
            const double step = glm::length(centroid(graph, beyond) - centroid(graph, faces[i]));
            queue.emplace(distance + step, it->second, s);
        }
    }
    std::array<std::vector<uint32_t>, 2> halves;
    for (size_t i = 0; i < faces.size(); ++i) halves[side[i] == 1 ? 1 : 0].push_back(faces[i]);
    return halves;
}

std::vector<std::vector<uint32_t>> connected_parts(const FaceGraph& graph, const std::vector<uint32_t>& faces) {
    const auto number = number_faces(faces);
    std::vector<bool> is_seen(faces.size(), false);
    std::vector<std::vector<uint32_t>> parts;
    for (uint32_t start = 0; start < faces.size(); ++start) {
        if (is_seen[start]) continue;
        is_seen[start] = true;
        std::vector<uint32_t> part;
        std::vector<uint32_t> open{start};
        while (!open.empty()) {
            const uint32_t i = open.back();
            open.pop_back();
            part.push_back(faces[i]);
            for (const uint32_t beyond : graph.neighbours[faces[i]]) {
                const auto it = number.find(beyond);
                if (it == number.end() || is_seen[it->second]) continue;
                is_seen[it->second] = true;
                open.push_back(it->second);
            }
        }
        std::sort(part.begin(), part.end());
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace surimi
