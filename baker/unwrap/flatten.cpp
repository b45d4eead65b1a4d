// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/flatten.h"

#include <algorithm>
#include <tuple>

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
        if (area < least * (1 - 1e-6)) {
            least = area;
            best = edge / length;
        }
    }
    return best;
}

/// Points that are level but for rounding made level, so that rounding does not choose where a hull begins.
std::vector<Vec2> without_rounding(std::vector<Vec2> points) {
    double largest = 0;
    for (const Vec2& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    if (!(largest > 0)) return points;
    const double step = 1e-7 * largest;
    for (Vec2& p : points) p = glm::round(p / step) * step;
    return points;
}

double area_of(const std::vector<Vec2>& hull) {
    double doubled = 0;
    for (size_t i = 2; i < hull.size(); ++i) doubled += doubled_area(hull[0], hull[i - 1], hull[i]);
    return 0.5 * doubled;
}

/// How much of the room between a chart and its convex hull stays empty on a packed map.
constexpr double empty_share = 0.3;

void turn_into_tightest_box(FlatChart& chart) {
    const std::vector<Vec2> hull = convex_hull(without_rounding(chart.points));
    const Vec2 axis = tightest_axis(hull);
    const double hollow = area_of(hull) - chart.flat_area;
    chart.need = chart.stretch * chart.stretch * chart.area * (1 + empty_share * hollow / chart.flat_area);
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

}  // namespace

FlatChart make_chart(const FaceGraph& graph, const Patch& patch, const Flattening& flat) {
    FlatChart chart;
    chart.faces = patch.faces;
    chart.area = patch.unit * patch.unit;
    chart.stretch = flat.distortion.stretch;
    chart.points.reserve(flat.points.size());
    for (const Vec2& p : flat.points) chart.points.push_back(patch.unit * p);
    for (size_t i = 0; i < patch.faces.size(); ++i) {
        const auto& t = patch.triangles[i];
        std::array<uint32_t, 3> corners{};
        for (size_t k = 0; k < 3; ++k) corners[(graph.first_corners[patch.faces[i]] + k) % 3] = t[k];
        chart.triangles.push_back(corners);
        chart.flat_area += 0.5 * doubled_area(chart.points[t[0]], chart.points[t[1]], chart.points[t[2]]);
    }
    turn_into_tightest_box(chart);
    return chart;
}

std::vector<std::array<uint32_t, 3>> neighbours_of(const FlatChart& chart) {
    struct Use {
        uint32_t low;
        uint32_t high;
        uint32_t corner;  // 3 * triangle + k
    };
    std::vector<Use> uses;
    uses.reserve(3 * chart.triangles.size());
    for (uint32_t t = 0; t < chart.triangles.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(chart.triangles[t][k], chart.triangles[t][(k + 1) % 3]);
            uses.push_back({low, high, 3 * t + k});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const Use& l, const Use& r) {
        return std::tie(l.low, l.high, l.corner) < std::tie(r.low, r.high, r.corner);
    });
    std::vector<std::array<uint32_t, 3>> neighbours(chart.triangles.size(), {no_face, no_face, no_face});
    for (size_t i = 1; i < uses.size(); ++i) {
        const Use& a = uses[i - 1];
        const Use& b = uses[i];
        if (a.low != b.low || a.high != b.high) continue;
        neighbours[a.corner / 3][a.corner % 3] = b.corner / 3;
        neighbours[b.corner / 3][b.corner % 3] = a.corner / 3;
    }
    return neighbours;
}

std::vector<Vec3> centroids_of(const FlatChart& chart) {
    std::vector<Vec3> centroids;
    centroids.reserve(chart.triangles.size());
    for (const auto& t : chart.triangles)
        centroids.emplace_back((chart.points[t[0]] + chart.points[t[1]] + chart.points[t[2]]) / 3.0, 0.0);
    return centroids;
}

std::vector<FlatChart> divide(const FaceGraph& graph, const FlatChart& chart, const std::vector<uint32_t>& parts) {
    const auto neighbours = neighbours_of(chart);
    std::vector<bool> is_seen(parts.size(), false);
    std::vector<FlatChart> pieces;
    std::vector<uint32_t> point(chart.points.size());  // of the chart -> of the piece
    for (uint32_t start = 0; start < parts.size(); ++start) {
        if (is_seen[start] || parts[start] == left_out) continue;
        is_seen[start] = true;
        std::vector<uint32_t> open{start};
        for (size_t i = 0; i < open.size(); ++i) {
            for (const uint32_t beyond : neighbours[open[i]]) {
                if (beyond == no_face || is_seen[beyond] || parts[beyond] != parts[start]) continue;
                is_seen[beyond] = true;
                open.push_back(beyond);
            }
        }
        std::sort(open.begin(), open.end());
        FlatChart piece;
        piece.surface = chart.surface;
        piece.stretch = chart.stretch;
        for (const uint32_t t : open)
            for (const uint32_t p : chart.triangles[t]) point[p] = left_out;
        for (const uint32_t t : open) {
            std::array<uint32_t, 3> corners{};
            for (size_t k = 0; k < 3; ++k) {
                uint32_t& p = point[chart.triangles[t][k]];
                if (p == left_out) {
                    p = static_cast<uint32_t>(piece.points.size());
                    piece.points.push_back(chart.points[chart.triangles[t][k]]);
                }
                corners[k] = p;
            }
            piece.faces.push_back(chart.faces[t]);
            piece.triangles.push_back(corners);
            piece.area += graph.areas[chart.faces[t]];
            piece.flat_area +=
                0.5 * doubled_area(piece.points[corners[0]], piece.points[corners[1]], piece.points[corners[2]]);
        }
        turn_into_tightest_box(piece);
        pieces.push_back(std::move(piece));
    }
    return pieces;
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

}  // namespace surimi
