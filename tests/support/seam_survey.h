// SPDX-License-Identifier: Apache-2.0
// Steps that a shader sees across seams of a baked scene, found by other means than the baker's: edges of triangles
// that are the same two places, exactly.
#pragma once

#include <array>
#include <vector>

#include "baker/bake.h"

namespace surimi::test {

/// An edge that two triangles share in space but not on the map, with agreeing normals.
struct SeamEdge {
    struct Side {
        TriangleRef triangle;
        std::array<size_t, 2> corners{0, 1};  ///< of the triangle: at the first place, at the second
    };
    std::array<Side, 2> sides;
};

/// All pairs, sorted; surfaces that are monitors left out. Normals agree where both ends' differ by less than 8 degrees
/// and the triangles lie on different sides of the edge.
std::vector<SeamEdge> find_seam_edges(const Scene& scene, const Atlas& atlas);

struct SeamPlace {
    double jump = 0;   ///< absolute difference of the two reads
    size_t edge = 0;   ///< index of its SeamEdge
    double share = 0;  ///< of the way along it
};

struct SeamJumps {
    size_t edges = 0;               ///< that were read at all
    std::vector<SeamPlace> places;  ///< sorted by jump; four a texel where both sides are measured

    double largest() const { return places.empty() ? 0 : places.back().jump; }
    /// The jump that this share does not exceed.
    double quantile(double share) const;
    /// Share of places that jump farther than this.
    double share_over(double jump) const;
};

/// A point of the surface on one side of an edge, a hundredth of the way towards the triangle's third corner.
SurfacePoint point_beside(const Scene& scene, const SeamEdge& edge, size_t side, double share);

/// Differences of bilinear reads along the edges, in one channel.
SeamJumps seam_jumps(const Bake& bake, const std::vector<SeamEdge>& edges, size_t channel);

}  // namespace surimi::test
