// SPDX-License-Identifier: Apache-2.0
// Growth on the map: known texels hand their values to the texels around them, a ring a round.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "runtime/base/image.h"

namespace surimi {

inline constexpr uint32_t no_chart = std::numeric_limits<uint32_t>::max();
inline constexpr int all_rings = std::numeric_limits<int>::max();

/// What a growth may do. Spans have one entry a texel of the map, or none.
struct GrowthRules {
    std::span<const uint32_t> only_chart;  ///< the one chart that a texel may belong to; none: any
    std::span<const uint8_t> keeps_value;  ///< not 0: a texel that is reached keeps the value that it has
    int rings = all_rings;                 ///< rounds at most
};

/// Grows from all texels that have an owner, the chart that their value belongs to, into those of `no_chart`, until no
/// more can be reached. A texel takes the mean of its up to eight neighbours of one owner that were known before the
/// round, and becomes that owner's: the one with the most such neighbours, then the lower number. Rounds are
/// double-buffered, so no scan order shows, and values of two charts never mix.
void grow(Image<float>& visibility, std::vector<uint32_t>& owner, const GrowthRules& rules);

}  // namespace surimi
