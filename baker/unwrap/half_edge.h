// SPDX-License-Identifier: Apache-2.0
// Surface -> which face lies beyond which edge, whatever the mesh: no face is refused, none is lost.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/base/math.h"
#include "runtime/scene/scene.h"

namespace surimi {

inline constexpr uint32_t no_face = UINT32_MAX;

/// The faces of one surface as a manifold: where three or more faces meet in an edge, only pairs that
/// continue each other are neighbours. Faces whose front sides disagree are never neighbours, because a
/// lightmap texel belongs to one front side.
struct FaceGraph {
    std::vector<Vec3> positions;                      ///< welded: every place once, metres
    std::vector<std::array<uint32_t, 3>> corners;     ///< of each triangle: indices into positions
    std::vector<std::array<uint32_t, 3>> neighbours;  ///< the face beyond the edge from corner k to k + 1, or no_face
    std::vector<Vec3> normals;                        ///< unit, of the front side
    std::vector<double> areas;                        ///< square metres
    std::vector<uint32_t> ranks;         ///< of each face: its place in an order that follows from the geometry alone
    std::vector<uint8_t> first_corners;  ///< of each face: the corner at its lowest place, where such an order starts
    std::vector<bool> is_sliver;         ///< no direction to speak of: area below 2e-12 of the longest edge squared.
                                         ///< Has no neighbours
    MeshCounts counts;
};

/// All faces, in the order of their ranks.
std::vector<uint32_t> by_rank(const FaceGraph& graph);

/// Welds vertices at identical places (-0.0 is 0.0) and finds the neighbours. What is found, and everything that walks
/// faces by rank, is the same for any order of the surface's triangles, vertices and corners. Places that differ in the
/// last digit stay apart: the file keeps them apart, and so does everyone who looks for seams in it.
FaceGraph build_face_graph(const Surface& surface);

}  // namespace surimi
