// SPDX-License-Identifier: Apache-2.0
// Gives every triangle of a primitive its place on the map, splitting vertices where two charts meet.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

using Triangle = std::array<uint32_t, 3>;

/// The vertices of a primitive after the split, in the order of the vertices they come from.
struct SplitVertices {
    std::vector<uint32_t> source;     ///< for each vertex, the one of the file that it copies
    std::vector<Vec2f> uv;            ///< for each vertex, its place on the map
    std::vector<Triangle> triangles;  ///< all of the file's, in its order and winding
    bool is_unchanged = false;  ///< no vertex was split or left out: source is 0, 1, 2, ..., triangles are the file's
};

/// `file_triangles` index the primitive's `vertex_count` vertices. Triangles that the Scene dropped for
/// having no area stay, with the uv that their vertices have elsewhere; where that would make them a point,
/// with the uv of some triangle of the surface, because tools take a point for a triangle that was forgotten.
/// Throws Error(scene) when surface and file do not fit together.
SplitVertices split_vertices(const Surface& surface, const SurfaceUv& uv, std::span<const Triangle> file_triangles,
                             size_t vertex_count);

}  // namespace surimi
