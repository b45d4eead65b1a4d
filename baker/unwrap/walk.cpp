// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/walk.h"

#include <queue>
#include <tuple>

#include "baker/unwrap/half_edge.h"

namespace surimi {

Walk walk_from(const std::vector<uint32_t>& sources, const std::vector<std::array<uint32_t, 3>>& neighbours,
               const std::vector<Vec3>& centroids) {
    using Step = std::tuple<float, uint32_t, uint32_t>;  // distance, triangle, source
    std::priority_queue<Step, std::vector<Step>, std::greater<>> queue;
    Walk walk{std::vector<float>(neighbours.size(), INFINITY), std::vector<uint32_t>(neighbours.size(), 0), 0};
    for (uint32_t s = 0; s < sources.size(); ++s) queue.emplace(0.0f, sources[s], s);
    std::vector<bool> is_reached(neighbours.size(), false);
    while (!queue.empty()) {
        const auto [distance, t, source] = queue.top();
        queue.pop();
        if (is_reached[t]) continue;
        is_reached[t] = true;
        walk.distance[t] = distance;
        walk.source[t] = source;
        walk.last = t;
        for (const uint32_t beyond : neighbours[t]) {
            if (beyond == no_face || is_reached[beyond]) continue;
            const auto step = static_cast<float>(glm::length(centroids[beyond] - centroids[t]));
            queue.emplace(distance + step, beyond, source);
        }
    }
    return walk;
}

}  // namespace surimi
