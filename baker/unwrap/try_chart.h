// SPDX-License-Identifier: Apache-2.0
// Whether a patch makes a chart: flat within a bound, and one to one.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "baker/unwrap/distortion.h"
#include "baker/unwrap/flatten.h"
#include "baker/unwrap/patch.h"

namespace surimi {

/// Two triangles of a chart that overlap deeper than rounding to 22 bits, if there are any.
std::optional<std::array<uint32_t, 2>> find_overlap(const FlatChart& chart);

struct TriedChart {
    std::optional<FlatChart> chart;
    std::array<uint32_t, 2> apart{0, 0};       ///< without a chart: two triangles of the patch that overlap, or 0 and 0
    std::vector<std::vector<uint32_t>> parts;  ///< faces to go on with instead; filled by the caller
};

/// Flattens the patch (M42) and looks for overlaps.
TriedChart try_chart(const FaceGraph& graph, const Patch& patch, const DistortionBound& bound);

}  // namespace surimi
