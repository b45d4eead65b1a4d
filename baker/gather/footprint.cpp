// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/footprint.h"

#include <cmath>
#include <limits>

namespace surimi {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

double second_difference(const TileGrid& grid, std::span<const double> values, const glm::ivec2& at,
                         const glm::ivec2& step) {
    for (const int shift : {-1, -2, 0}) {  // of the row's first texel
        std::array<double, 3> row{};
        bool is_whole = true;
        for (int k = 0; k < 3 && is_whole; ++k) {
            const glm::ivec2 p = at + (shift + k) * step;
            is_whole = p.x >= 0 && p.y >= 0 && p.x < tile_size && p.y < tile_size;
            const int member = is_whole ? grid[static_cast<size_t>(p.y * tile_size + p.x)] : -1;
            is_whole = member >= 0;
            if (is_whole) row[static_cast<size_t>(k)] = values[static_cast<size_t>(member)];
        }
        if (!is_whole) continue;
        const double difference = std::abs(row[0] - 2 * row[1] + row[2]);
        return std::isfinite(difference) ? difference : unknown;  // of two unknown values it is no number
    }
    return unknown;
}

}  // namespace

Vec2 second_differences(const TileGrid& grid, std::span<const double> values, int x, int y) {
    return {second_difference(grid, values, {x, y}, {1, 0}), second_difference(grid, values, {x, y}, {0, 1})};
}

double footprint_error(const Vec2& differences) {
    return (differences.x + differences.y) / 24;
}

}  // namespace surimi
