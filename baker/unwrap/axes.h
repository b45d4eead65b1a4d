// SPDX-License-Identifier: Apache-2.0
// The directions in which a chart is worth laying on a map.
#pragma once

#include <vector>

#include "baker/unwrap/footprint.h"

namespace surimi {

/// Unit vectors of the chart's plane that may come to lie along x, up to three. The first is (1, 0): the box in which
/// the chart stands. Then the direction in which it needs the smallest map of this form, where that is another one (a
/// long strip: along the diagonal), and those of other tight boxes. Turns by right angles are not told apart.
std::vector<Vec2> pack_axes(const FlatChart& chart, const Outline& outline, const MapSize& map);

}  // namespace surimi
