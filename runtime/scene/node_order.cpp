// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/node_order.h"

namespace surimi {

std::vector<size_t> parents_first(const Scene& scene) {
    std::vector<std::vector<size_t>> children(scene.nodes.size());
    std::vector<size_t> order;
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].parent < 0)
            order.push_back(n);
        else
            children[static_cast<size_t>(scene.nodes[n].parent)].push_back(n);
    }
    for (size_t i = 0; i < order.size(); ++i) {
        const std::vector<size_t>& below = children[order[i]];
        order.insert(order.end(), below.begin(), below.end());
    }
    return order;
}

}  // namespace surimi
