// SPDX-License-Identifier: Apache-2.0
// A chart at a density -> its place in whole texels, and the texels that it touches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/flatten.h"

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

/// `texels_per_metre` counts along the surface in space. Charts thinner than a fraction of a texel are
/// widened: that costs no texel and keeps float rounding from collapsing them.
TexelChart to_texels(const FlatChart& chart, double texels_per_metre, const MapSize& map);

/// Point of a chart turned counter-clockwise by `turns` right angles within its box.
Vec2 turned(const Vec2& p, const TexelChart& chart, int turns);

/// Touched texels as runs of rows, sorted by row, at most a few for each row.
struct Mask {
    struct Run {
        int row = 0;
        int begin = 0;
        int length = 0;
    };
    int width = 0;
    int height = 0;
    size_t texels = 0;
    std::vector<Run> runs;
};

/// The chart's texels under 1, 2 or 4 rotations (fewer where the mask is a full rectangle and turning changes
/// nothing). A texel is touched when a triangle, grown by coordinate_slack, meets its open square.
std::vector<Mask> make_masks(const FlatChart& chart, const TexelChart& shape, const MapSize& map);

}  // namespace surimi
