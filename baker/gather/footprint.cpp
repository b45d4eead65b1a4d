// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace surimi {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The value at a place of the grid, if a texel is there.
std::optional<double> value_at(const TileGrid& grid, std::span<const double> values, const glm::ivec2& p) {
    if (p.x < 0 || p.y < 0 || p.x >= tile_size || p.y >= tile_size) return std::nullopt;
    const int member = grid[static_cast<size_t>(p.y * tile_size + p.x)];
    if (member < 0 || !std::isfinite(values[static_cast<size_t>(member)])) return std::nullopt;
    return values[static_cast<size_t>(member)];
}

double second_difference(const TileGrid& grid, std::span<const double> values, const glm::ivec2& at,
                         const glm::ivec2& step) {
    const double center = value_at(grid, values, at).value_or(unknown);
    if (!std::isfinite(center)) return unknown;
    const auto left = value_at(grid, values, at - step), right = value_at(grid, values, at + step);
    if (left && right) return std::abs(*left - 2 * center + *right);
    const auto neighbour = left ? left : right;
    if (!neighbour) return unknown;
    const auto beyond = value_at(grid, values, left ? at - 2 * step : at + 2 * step);
    // Of a pair nothing is known but that it may be a step.
    return beyond ? std::abs(center - 2 * *neighbour + *beyond) : std::abs(center - *neighbour);
}

}  // namespace

Vec2 second_differences(const TileGrid& grid, std::span<const double> values, int x, int y) {
    return {second_difference(grid, values, {x, y}, {1, 0}), second_difference(grid, values, {x, y}, {0, 1})};
}

double footprint_error(const Vec2& differences) {
    return (differences.x + differences.y) / 10;
}

double diagonal_difference(const TileGrid& grid, std::span<const double> values, int x, int y) {
    const auto center = value_at(grid, values, {x, y});
    double largest = 0;
    for (const glm::ivec2& step : {glm::ivec2(1, 1), glm::ivec2(1, -1)}) {
        const auto before = value_at(grid, values, glm::ivec2(x, y) - step);
        const auto after = value_at(grid, values, glm::ivec2(x, y) + step);
        if (center && before && after) largest = std::max(largest, std::abs(*before - 2 * *center + *after));
    }
    return largest;
}

double footprint_error(const Vec2& second_differences, double diagonal_difference) {
    // A diagonal's has both axes' in it where light is smooth.
    return std::max(footprint_error(second_differences), diagonal_difference / 20);
}

}  // namespace surimi
