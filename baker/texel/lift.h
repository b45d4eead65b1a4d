// SPDX-License-Identifier: Apache-2.0
// Where the points of a coarse smooth surface would lie if it were as round as its shading normals say.
#pragma once

#include <array>
#include <optional>

#include "baker/texel/texel_surface.h"

namespace surimi {

/// A triangle that bulges over itself: tangent planes at its corners, of which some leave others below.
struct RoundTriangle {
    std::array<Vec3, 3> normals;  ///< unit, at the corners
    /// [i][j]: metres that corner j lies below the tangent plane of corner i, over 1 + cosine of their normals; of i
    /// and j the larger. Negative where the side between them is hollow.
    Mat3 bulges{0};
    Vec3 geometric_normal{0, 0, 1};

    /// What moves the point with these weights to the mean of the tangent planes, outward only (M63); 0 at corners.
    Vec3 lift(const Vec3& barycentric) const;
};

/// Nothing where no tangent plane rises from the triangle by more than a milliradian (flat and hollow ones), or where a
/// normal leans by more than some 32 degrees from the triangle's: a box with averaged normals is not meant to be round.
std::optional<RoundTriangle> round_triangle(const Surface& surface, uint32_t triangle);

/// The piece's position, lifted: in the middle exactly, to first order around it, and nowhere below the triangle.
/// Nothing where its middle stays.
std::optional<TexelSurface::Affine> lifted_position(const RoundTriangle& round, const TexelSurface::Piece& piece);

}  // namespace surimi
