// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/relief.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "baker/unwrap/curvature.h"
#include "baker/unwrap/seam_cost.h"
#include "baker/unwrap/try_chart.h"

namespace surimi {
namespace {

constexpr uint32_t no_corner = UINT32_MAX;

/// The ways from the boundary to every vertex that show least.
struct Ways {
    std::vector<float> cost;
    std::vector<uint32_t> arrival;  ///< 3 * triangle + k of the edge by which the way comes, or no_corner
    std::vector<uint32_t> from;     ///< the vertex before
};

Ways ways_from_boundary(const FaceGraph& graph, const Patch& patch) {
    const size_t count = patch.positions.size();
    struct Exit {
        uint32_t vertex;
        uint32_t corner;
        float cost;
    };
    std::vector<std::vector<Exit>> exits(count);
    constexpr double hidden = 0.05;  // of a visible edge's cost
    for (uint32_t t = 0; t < patch.triangles.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            if (patch.neighbours[t][k] == no_face || patch.neighbours[t][k] < t) continue;
            SeamLength length;
            add_edge(graph, patch.faces[t], (graph.first_corners[patch.faces[t]] + k) % 3, length);
            const auto cost = static_cast<float>((length.visible + hidden * length.all) / patch.unit);
            const uint32_t a = patch.triangles[t][k];
            const uint32_t b = patch.triangles[t][(k + 1) % 3];
            exits[a].push_back({b, 3 * t + k, cost});
            exits[b].push_back({a, 3 * t + k, cost});
        }
    }
    Ways ways{std::vector<float>(count, INFINITY), std::vector<uint32_t>(count, no_corner), std::vector<uint32_t>(count)};
    using Step = std::tuple<float, uint32_t>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> queue;
    for (const auto& loop : patch.loops) {
        for (const uint32_t v : loop) {
            ways.cost[v] = 0;
            queue.emplace(0.0f, v);
        }
    }
    while (!queue.empty()) {
        const auto [cost, v] = queue.top();
        queue.pop();
        if (cost > ways.cost[v]) continue;
        for (const Exit& exit : exits[v]) {
            const float there = cost + exit.cost;
            if (!(there < ways.cost[exit.vertex])) continue;
            ways.cost[exit.vertex] = there;
            ways.arrival[exit.vertex] = exit.corner;
            ways.from[exit.vertex] = v;
            queue.emplace(there, exit.vertex);
        }
    }
    return ways;
}

/// Vertices whose scale is below 1 and below that of all around them, the smallest scale first: there the surface is
/// domed, and a slit opens. Where the scale is above 1 a slit would close over itself.
std::vector<uint32_t> find_domes(const Patch& patch, const std::vector<double>& logarithms) {
    std::vector<bool> is_lowest(logarithms.size(), true);
    for (const auto& t : patch.triangles)
        for (size_t k = 0; k < 3; ++k)
            for (size_t i = 1; i < 3; ++i)
                if (!(logarithms[t[k]] < logarithms[t[(k + i) % 3]])) is_lowest[t[k]] = false;
    std::vector<uint32_t> domes;
    for (uint32_t v = 0; v < logarithms.size(); ++v)
        if (is_lowest[v] && logarithms[v] < 0) domes.push_back(v);
    std::sort(domes.begin(), domes.end(), [&](uint32_t a, uint32_t b) {
        return std::make_tuple(static_cast<float>(logarithms[a]), a) < std::make_tuple(static_cast<float>(logarithms[b]), b);
    });
    return domes;
}

void cut_way(const FaceGraph& graph, const Patch& patch, const Ways& ways, uint32_t end, Seams& seams) {
    for (uint32_t v = end; ways.arrival[v] != no_corner; v = ways.from[v]) {
        const uint32_t face = patch.faces[ways.arrival[v] / 3];
        set_seam(graph, face, (graph.first_corners[face] + ways.arrival[v] % 3) % 3, true, seams);
    }
}

/// The points of the same faces' vertices in another patch, which is cut further.
std::vector<Vec2> carry_over(const Patch& from, const std::vector<Vec2>& points, const Patch& to) {
    std::vector<Vec2> result(to.positions.size());
    for (size_t t = 0; t < to.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) result[to.triangles[t][k]] = points[from.triangles[t][k]];
    return result;
}

}  // namespace

std::optional<FlatChart> relieve(const FaceGraph& graph, const Patch& whole, const DistortionBound& bound,
                                 std::vector<uint32_t>& number, Seams& seams) {
    constexpr double nearly = 1.5;  // times what the bound allows above an isometry
    const DistortionBound loose{4 + nearly * (bound.energy - 4), 1 + nearly * (bound.stretch - 1)};
    const std::vector<double> logarithms = conformal_logarithms(whole);
    if (!(predicted_energy(whole, logarithms) <= loose.energy)) return std::nullopt;
    std::optional<Flattening> flat = flatten_within(whole, logarithms, loose);
    if (!flat) return std::nullopt;

    Patch patch = whole;
    std::vector<uint32_t> ends;
    for (const uint32_t v : find_domes(whole, logarithms)) {
        constexpr double apart = 0.15;  // slits side by side do the same work twice; the patch has area 1
        const auto is_near = [&](uint32_t other) {
            return glm::length(whole.positions[other] - whole.positions[v]) < apart;
        };
        if (std::none_of(ends.begin(), ends.end(), is_near)) ends.push_back(v);
    }
    constexpr size_t most_slits = 16;
    ends.resize(std::min(ends.size(), most_slits));
    const Ways ways = ways_from_boundary(graph, whole);
    for (const uint32_t end : ends) {
        Seams slit = seams;
        cut_way(graph, whole, ways, end, slit);
        Patch opened = build_patch(graph, slit, whole.faces, number);
        Flattening relaxed{carry_over(patch, flat->points, opened), {}};
        Laplacian laplacian(opened);
        relax(opened, bound.energy, laplacian, relaxed.points);
        relaxed.distortion = measure_distortion(opened, relaxed.points);
        constexpr double least_gain = 0.005;  // of what is above an isometry
        if (!(relaxed.distortion.energy - 4 < (1 - least_gain) * (flat->distortion.energy - 4))) continue;
        FlatChart chart = make_chart(graph, opened, relaxed);
        if (find_overlap(chart)) continue;
        if (is_within(relaxed.distortion, bound)) {
            seams = std::move(slit);
            return chart;
        }
        patch = std::move(opened);
        flat = std::move(relaxed);
        seams = std::move(slit);
    }
    return std::nullopt;
}

}  // namespace surimi
