// SPDX-License-Identifier: Apache-2.0
// The edges of a whole scene with their uv on either side: what is joined on the map, and what is cut.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

/// One triangle's side of an edge.
struct EdgeUse {
    uint32_t low = 0;  ///< its ends by place, low < high
    uint32_t high = 0;
    Vec2f uv_low{0};
    Vec2f uv_high{0};
    TriangleRef triangle;
    uint32_t corner = 0;  ///< the edge runs from this corner to the next
};

/// All sides of all edges on the map: those of one edge (ends at identical places, -0.0 is 0.0, whatever the surface)
/// side by side, those of nearly equal uv next to each other. Edges of no length are left out. n log n.
std::vector<EdgeUse> find_edge_uses(const Scene& scene, const std::vector<SurfaceUv>& surfaces);

/// Calls `visit` for the sides of each edge.
void visit_edges(std::span<const EdgeUse> uses, const std::function<void(std::span<const EdgeUse>)>& visit);

/// Whether two sides of one edge lie on the same place of the map (to 1e-6, a few steps of float), and not in a point.
bool are_joined(const EdgeUse& a, const EdgeUse& b);

/// Whether the map shows no side of this edge beside another side of it that lies elsewhere.
bool is_cut(std::span<const EdgeUse> edge);

/// Area at most 1e-12 of the longest edge squared: no direction to speak of.
bool is_needle(const Surface& surface, uint32_t triangle);

}  // namespace surimi
