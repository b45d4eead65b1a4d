// SPDX-License-Identifier: Apache-2.0
// A placed chart in the coordinates that the file will hold, repaired where rounding hurt it, and judged.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/footprint.h"
#include "baker/unwrap/pack.h"

namespace surimi {

/// Coordinates are whole numbers of uv_step, so that every test on them is exact and float holds them
/// exactly.
struct RoundedChart {
    std::vector<Vec2> points;                          ///< for each of FlatChart::points
    std::vector<uint32_t> bad;                         ///< triangles that are flipped or collapsed
    std::vector<std::array<uint32_t, 2>> overlapping;  ///< pairs of triangles, some of them
};

/// Rounding moves points by half a step. Where that flips a needle, or lets an edge cross a vertex that lay
/// on it, points move by a few steps more (at most 8, a ten-thousandth of a texel at 1024): nothing else in
/// the chart notices. What cannot be repaired so is named in `bad` and `overlapping`.
RoundedChart round_chart(const FlatChart& chart, const TexelChart& shape, const Placement& placement,
                         const MapSize& map);

}  // namespace surimi
