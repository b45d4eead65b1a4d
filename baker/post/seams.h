// SPDX-License-Identifier: Apache-2.0
// Seams: where two borders of charts are one edge in the world, so that the map has its values twice.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// One side of a piece of seam.
struct SeamSide {
    int page = 0;
    uint32_t chart = 0;          ///< index into Atlas::charts
    std::array<Vec2, 2> texels;  ///< where the two ends of the piece are on the page; straight in between
};

/// A straight piece along which two charts meet.
struct SeamPiece {
    std::array<SeamSide, 2> sides;  ///< the ends of both are in the same order
    double length = 0;              ///< metres
};

struct Seams {
    std::vector<SeamPiece> pieces;
};

/// Every piece of edge along which two borders of charts coincide in the world and surface goes on: one triangle lies
/// to the left of it and one to the right, within a bend that smooth surfaces have, with equal shading normals at both
/// ends (M60). The borders may belong to one chart (a cut), to two, to two surfaces or to two pages; edges of
/// different lengths meet in as far as they overlap. Copies of one face and the two faces of a sheet are no seams.
/// Where more than two borders meet, all pairs, up to 16 for the shorter edge of a pair. For the same scene and atlas
/// the same pieces in the same order; n log n; parallel.
Seams find_seams(const Scene& scene, const Atlas& atlas);

}  // namespace surimi
