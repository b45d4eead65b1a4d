// SPDX-License-Identifier: Apache-2.0
// The directions in which a chart is worth laying on a map.
#pragma once

#include <vector>

#include "baker/unwrap/footprint.h"

namespace surimi {

/// Unit vectors of the chart's plane that may come to lie along x, the best first: the box that the chart stands in,
/// other boxes of little more area (standing on edges of its hull), and the direction in which it needs the least of
/// the map (a long strip: along the diagonal). Turns by right angles are not told apart.
std::vector<Vec2> pack_axes(const FlatChart& chart, const MapSize& map);

}  // namespace surimi
