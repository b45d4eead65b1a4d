// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/relief.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "baker/unwrap/seam_cost.h"

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

}  // namespace

bool cut_relief(const FaceGraph& graph, const Patch& patch, const std::vector<double>& logarithms, Seams& seams) {
    const Ways ways = ways_from_boundary(graph, patch);
    // A slit takes the scale to 1 at its end and along its way. Where the scale is below 1 the surface is domed and the
    // slit opens; elsewhere it would close over itself.
    uint32_t best = no_corner;
    float most = 0;
    for (uint32_t v = 0; v < patch.positions.size(); ++v) {
        if (ways.arrival[v] == no_corner || !(logarithms[v] < 0)) continue;
        const auto gain = static_cast<float>(logarithms[v] * logarithms[v]) / (0.02f + ways.cost[v]);
        if (gain > most) most = gain, best = v;
    }
    if (best == no_corner) return false;
    for (uint32_t v = best; ways.arrival[v] != no_corner; v = ways.from[v]) {
        const uint32_t face = patch.faces[ways.arrival[v] / 3];
        set_seam(graph, face, (graph.first_corners[face] + ways.arrival[v] % 3) % 3, true, seams);
    }
    return true;
}

}  // namespace surimi
