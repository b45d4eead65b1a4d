// SPDX-License-Identifier: Apache-2.0
// Trees of bounding boxes over edges and triangles: binned surface area heuristic, depth-first, built in parallel.
#pragma once

#include <array>
#include <vector>

#include "baker/gather/silhouettes.h"

namespace surimi {

/// No node lies deeper, so a stack of this size suffices to walk a tree.
inline constexpr size_t deepest_node = 96;

/// Puts `items` in the tree's order and returns its nodes, without cones; none without items. Parallel; the result
/// does not depend on the number of threads.
std::vector<EdgeNode> build_boxes(std::vector<Edge>& items);
std::vector<EdgeNode> build_boxes(std::vector<std::array<Vec3f, 3>>& items);

}  // namespace surimi
