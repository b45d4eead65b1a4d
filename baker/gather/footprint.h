// SPDX-License-Identifier: Apache-2.0
// How far the value at a texel's centre may be from the average over the texel.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "baker/gather/blocks.h"

namespace surimi {

/// Where the texels of a block lie in its tile: [y * tile_size + x] -> number within the block, or -1.
using TileGrid = std::array<int16_t, size_t{tile_size} * tile_size>;

/// Second differences of a block's values along both axes at texel (x, y), from the three texels in a row that lie
/// best: the texel in the middle, else at an end. Of two in a row the difference; infinite where there is no neighbour,
/// so that nothing is known. Values that are not finite count as missing.
Vec2 second_differences(const TileGrid& grid, std::span<const double> values, int x, int y);

/// What the average over a texel may differ from the value at its centre, by the second differences (M56): a parabola's
/// is off by a 24th of them, a kink's by an eighth.
double footprint_error(const Vec2& second_differences);

/// The larger of the second differences along the two diagonals, of those that the tile has both ends of: where only
/// the corner of a shadow falls between the centres, the axes show nothing.
double diagonal_difference(const TileGrid& grid, std::span<const double> values, int x, int y);

/// The same as footprint_error, by both.
double footprint_error(const Vec2& second_differences, double diagonal_difference);

}  // namespace surimi
