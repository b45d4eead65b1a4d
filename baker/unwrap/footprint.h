// SPDX-License-Identifier: Apache-2.0
// A chart at a density -> its place in whole texels, and the texels that it touches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/flatten.h"
#include "baker/unwrap/mask.h"

namespace surimi {

/// The map as charts see it.
struct MapSize {
    int width = 0;
    int height = 0;
};

/// Floats in [0.5, 1) are this far apart: every texture coordinate of an atlas is a multiple, so that float
/// holds it exactly.
inline constexpr double uv_step = 1.0 / (1 << 24);

/// Texels by which a final coordinate may differ from the one that was packed: rounding to uv_step, twice,
/// and repairs.
double coordinate_slack(const MapSize& map);

/// A chart in texels: points within [0, width] x [0, height], at least coordinate_slack away from the sides.
struct TexelChart {
    std::vector<Vec2> points;
    int width = 1;
    int height = 1;
    double texels_per_metre = 0;  ///< after widening charts that would be too small for float; 0 for slivers
};

/// Coordinates of a point in a frame whose x runs along `axis`, of unit length.
inline Vec2 to_axis(const Vec2& p, const Vec2& axis) {
    return {glm::dot(p, axis), axis.x * p.y - axis.y * p.x};
}

/// `texels_per_metre` counts along the surface in space; `axis` (a unit vector) is the direction of the chart that
/// comes to lie along x. The box is a multiple of `cell` texels in both directions. Charts thinner than a fraction of a
/// texel are widened: that costs no texel and keeps float rounding from collapsing them.
TexelChart to_texels(const FlatChart& chart, double texels_per_metre, const MapSize& map, const Vec2& axis = {1, 0},
                     int cell = 1);

/// Added to a number of right angles: first mirrored (x becomes width - x).
inline constexpr int mirrored = 4;

/// Point of a chart within its box, mirrored from `turns` = 4 on, then turned counter-clockwise by `turns` mod 4 right
/// angles.
Vec2 turned(const Vec2& p, const TexelChart& chart, int turns);

/// The edges of a chart with a triangle on one side only, as indices into its points. All edges where there is none
/// such: triangles that lie on each other, which round_chart finds.
using Outline = std::vector<std::array<uint32_t, 2>>;
Outline chart_outline(const FlatChart& chart);

/// The chart's texels in the eight poses of turned(), those left out that equal one before. A texel is touched when the
/// chart, grown by coordinate_slack, meets its open square. With `cell` above 1 the masks count cells of so many
/// texels in both directions, touched when one of their texels is; the shape's box has to be a multiple.
std::vector<Mask> make_masks(const Outline& outline, const TexelChart& shape, const MapSize& map, int cell = 1);

}  // namespace surimi
