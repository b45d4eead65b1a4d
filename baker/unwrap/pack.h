// SPDX-License-Identifier: Apache-2.0
// Masks of touched texels -> places on a map of a given size.
#pragma once

#include <optional>
#include <vector>

#include "baker/unwrap/footprint.h"

namespace surimi {

struct Placement {
    int x = 0;
    int y = 0;
    int turns = 0;  ///< right angles, counter-clockwise; index into the chart's masks
};

/// Places every chart (given by its masks under rotation) so that at least `gutter` untouched texels separate the
/// touched texels of two charts. Largest first, under up to three meanings of "largest", each chart as low as it
/// goes. Nothing if they do not fit. Deterministic.
std::optional<std::vector<Placement>> pack(const std::vector<std::vector<Mask>>& charts, const MapSize& map,
                                           int gutter);

/// A lower bound of the texels that charts and gutters need; a map with fewer than (width + gutter) * (height
/// + gutter) cannot hold them.
double least_texels(const std::vector<std::vector<Mask>>& charts, int gutter);

}  // namespace surimi
