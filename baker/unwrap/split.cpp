// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/split.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "baker/unwrap/min_cut.h"
#include "baker/unwrap/seam_cost.h"
#include "baker/unwrap/walk.h"

namespace surimi {
namespace {

constexpr uint8_t no_side = 2;

/// Costs are compared as floats: what is equal but for rounding is equal, and the face's number decides.
using Step = std::tuple<float, uint32_t, uint8_t>;  // cost, face, side
using Queue = std::priority_queue<Step, std::vector<Step>, std::greater<>>;

struct Shape {
    Vec3 normal;
    Vec3 place;
};

std::vector<Shape> shapes_of(const Patch& patch) {
    const std::vector<Vec3> places = centroids(patch);
    std::vector<Shape> shapes;
    shapes.reserve(places.size());
    for (size_t i = 0; i < places.size(); ++i) {
        const auto& t = patch.triangles[i];
        const Vec3 normal = area_normal(patch.positions[t[0]], patch.positions[t[1]], patch.positions[t[2]]);
        shapes.push_back({normalize_or(normal, Vec3(0)), places[i]});
    }
    return shapes;
}

/// Weight of squared distances (the patch has area 1) against squared differences of unit normals: compact parts, but
/// long tubes are still cut lengthwise.
constexpr double place_weight = 0.5;

double difference(const Shape& a, const Shape& b) {
    const Vec3 n = a.normal - b.normal;
    const Vec3 p = a.place - b.place;
    return glm::dot(n, n) + place_weight * glm::dot(p, p);
}

uint32_t most_different(const std::vector<Shape>& shapes, const Shape& from) {
    uint32_t best = 0;
    float most = -1;
    for (uint32_t t = 0; t < shapes.size(); ++t) {
        const auto d = static_cast<float>(difference(shapes[t], from));
        if (d > most) most = d, best = t;
    }
    return best;
}

Shape mean_of(const Patch& patch, const std::vector<Shape>& shapes, const std::vector<uint8_t>& sides, uint8_t side) {
    Shape sum{Vec3(0), Vec3(0)};
    double area = 0;
    for (size_t t = 0; t < shapes.size(); ++t) {
        if (sides[t] != side) continue;
        sum.normal += patch.areas[t] * shapes[t].normal;
        sum.place += patch.areas[t] * shapes[t].place;
        area += patch.areas[t];
    }
    // Of a closed patch the normals cancel but for rounding: it has no direction.
    constexpr double rounding = 1e-9;
    const bool is_directed = glm::length(sum.normal) > rounding * area;
    return {is_directed ? glm::normalize(sum.normal) : Vec3(0), sum.place / area};
}

/// Grows two parts from their seeds, always by the face that differs least from its part's mean.
std::vector<uint8_t> grow(const Patch& patch, const std::vector<Shape>& shapes, const std::array<Shape, 2>& means,
                          const std::array<uint32_t, 2>& seeds) {
    Queue queue;
    std::vector<uint8_t> sides(shapes.size(), no_side);
    for (uint8_t s = 0; s < 2; ++s) queue.emplace(-1.0f, seeds[s], s);
    while (!queue.empty()) {
        const auto [cost, t, side] = queue.top();
        queue.pop();
        if (sides[t] != no_side) continue;
        sides[t] = side;
        for (const uint32_t beyond : patch.neighbours[t])
            if (beyond != no_face && sides[beyond] == no_side)
                queue.emplace(static_cast<float>(difference(shapes[beyond], means[side])), beyond, side);
    }
    return sides;
}

uint32_t nearest_to(const std::vector<Shape>& shapes, const std::vector<uint8_t>& sides, uint8_t side,
                    const Shape& mean) {
    uint32_t best = no_face;
    float least = INFINITY;
    for (uint32_t t = 0; t < shapes.size(); ++t) {
        if (sides[t] != side) continue;
        const auto d = static_cast<float>(difference(shapes[t], mean));
        if (best == no_face || d < least) least = d, best = t;
    }
    return best;
}

}  // namespace

std::vector<Vec3> centroids(const Patch& patch) {
    std::vector<Vec3> result;
    result.reserve(patch.triangles.size());
    for (const auto& t : patch.triangles)
        result.push_back((patch.positions[t[0]] + patch.positions[t[1]] + patch.positions[t[2]]) / 3.0);
    return result;
}

std::vector<uint8_t> split_between(const std::vector<std::array<uint32_t, 3>>& neighbours,
                                   const std::vector<Vec3>& centroids, const std::array<uint32_t, 2>& seeds) {
    const Walk walk = walk_from({seeds[0], seeds[1]}, neighbours, centroids);
    std::vector<uint8_t> sides(neighbours.size());
    for (size_t t = 0; t < sides.size(); ++t) sides[t] = static_cast<uint8_t>(walk.source[t]);
    return sides;
}

std::vector<uint8_t> split_by_shape(const Patch& patch) {
    const std::vector<Shape> shapes = shapes_of(patch);
    const std::vector<uint8_t> all(shapes.size(), 0);
    std::array<uint32_t, 2> seeds{};
    seeds[0] = most_different(shapes, mean_of(patch, shapes, all, 0));
    seeds[1] = most_different(shapes, shapes[seeds[0]]);
    if (seeds[0] == seeds[1]) seeds[1] = seeds[0] == 0 ? 1 : 0;
    std::array<Shape, 2> means{shapes[seeds[0]], shapes[seeds[1]]};
    std::vector<uint8_t> sides;
    constexpr int rounds = 6;  // the parts hardly change after
    for (int i = 0; i < rounds; ++i) {
        sides = grow(patch, shapes, means, seeds);
        for (uint8_t s = 0; s < 2; ++s) {
            means[s] = mean_of(patch, shapes, sides, s);
            seeds[s] = nearest_to(shapes, sides, s, means[s]);
        }
    }
    return sides;
}

namespace {

/// The distance up to which there are `count` triangles at most.
float nearest(std::vector<float> distances, size_t count) {
    if (count >= distances.size()) return INFINITY;
    const auto at = distances.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(distances.begin(), at, distances.end());
    return *at;
}

}  // namespace

void straighten(const FaceGraph& graph, const Patch& patch, std::vector<uint8_t>& sides) {
    std::vector<uint32_t> border;
    for (uint32_t t = 0; t < sides.size(); ++t) {
        const auto is_other = [&](uint32_t beyond) { return beyond != no_face && sides[beyond] != sides[t]; };
        if (std::any_of(patch.neighbours[t].begin(), patch.neighbours[t].end(), is_other)) border.push_back(t);
    }
    const Walk walk = walk_from(border, patch.neighbours, centroids(patch));
    std::array<float, 2> deepest{0, 0};
    for (size_t t = 0; t < sides.size(); ++t) deepest[sides[t]] = std::max(deepest[sides[t]], walk.distance[t]);
    // The faces far from the border, the farthest at least, stay on their sides: node 0 and node 1.
    constexpr float widest = 0.15f;      // the patch has area 1
    constexpr size_t most_moved = 6000;  // faces; finding the cut takes more than linear time
    const float width = std::min({widest, 0.6f * std::min(deepest[0], deepest[1]), nearest(walk.distance, most_moved)});
    std::vector<uint32_t> node(sides.size());
    uint32_t nodes = 2;
    for (size_t t = 0; t < sides.size(); ++t) {
        const bool is_core = walk.distance[t] > width || walk.distance[t] >= deepest[sides[t]];
        node[t] = is_core ? sides[t] : nodes++;
    }
    MinCut cut(nodes);
    constexpr double steps = 1e6;    // to a unit of length
    constexpr double hidden = 0.02;  // what a cut on a crease counts, against a visible one
    for (uint32_t t = 0; t < sides.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t beyond = patch.neighbours[t][k];
            if (beyond == no_face || beyond < t || node[t] == node[beyond]) continue;
            SeamLength length;
            add_edge(graph, patch.faces[t], (graph.first_corners[patch.faces[t]] + k) % 3, length);
            const double cost = (length.visible + hidden * length.all) / patch.unit;
            cut.add_edge(node[t], node[beyond], std::llround(cost * steps));
        }
    }
    const std::vector<bool> stays = cut.separate(0, 1);
    for (size_t t = 0; t < sides.size(); ++t) sides[t] = stays[node[t]] ? 0 : 1;
}

void cut_between(const FaceGraph& graph, const Patch& patch, const std::vector<uint8_t>& sides, SeamFlags& seams) {
    for (uint32_t t = 0; t < sides.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t beyond = patch.neighbours[t][k];
            if (beyond == no_face || sides[beyond] == sides[t]) continue;
            set_seam(graph, patch.faces[t], (graph.first_corners[patch.faces[t]] + k) % 3, true, seams);
        }
    }
}

}  // namespace surimi
