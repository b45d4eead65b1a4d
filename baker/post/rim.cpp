// SPDX-License-Identifier: Apache-2.0
#include "baker/post/rim.h"

#include <algorithm>
#include <utility>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr size_t grain = 16;  // lines that one thread takes at a time

/// A line of texels in a map: every `step` from `first`.
struct Line {
    size_t first = 0, step = 1, count = 0;
};

/// Sets to 1 what lies within `reach` texels of a 1 on the line.
void spread_along(std::vector<uint8_t>& mask, const Line& line, size_t reach) {
    std::vector<uint8_t> spread_mask(line.count, 0);
    size_t since = reach + 1;  // texels since the last 1
    for (size_t i = 0; i < line.count; ++i) {
        since = mask[line.first + i * line.step] != 0 ? 0 : std::min(since + 1, reach + 1);
        spread_mask[i] = since <= reach;
    }
    since = reach + 1;
    for (size_t i = line.count; i-- > 0;) {
        since = mask[line.first + i * line.step] != 0 ? 0 : std::min(since + 1, reach + 1);
        spread_mask[i] |= since <= reach;
    }
    for (size_t i = 0; i < line.count; ++i) mask[line.first + i * line.step] = spread_mask[i];
}

}  // namespace

std::vector<uint8_t> rim(std::span<const uint64_t> kinds, int width, int rings) {
    const auto columns = static_cast<size_t>(width);
    const size_t rows = columns > 0 ? kinds.size() / columns : 0;
    std::vector<uint8_t> mask(kinds.size(), 1);
    parallel_for(rows, grain, [&](size_t y) {
        if (y == 0 || y + 1 == rows) return;
        for (size_t x = 1; x + 1 < columns; ++x) {
            const size_t i = y * columns + x;
            bool is_rim = false;
            for (const size_t row : {i - columns, i, i + columns})
                for (const size_t j : {row - 1, row, row + 1}) is_rim = is_rim || kinds[j] != kinds[i];
            mask[i] = is_rim;
        }
    });
    return rings > 1 ? spread(std::move(mask), width, rings - 1) : mask;
}

std::vector<uint8_t> spread(std::vector<uint8_t> mask, int width, int rings) {
    const auto columns = static_cast<size_t>(width), reach = static_cast<size_t>(rings);
    const size_t rows = columns > 0 ? mask.size() / columns : 0;
    parallel_for(rows, grain, [&](size_t y) { spread_along(mask, {y * columns, 1, columns}, reach); });
    parallel_for(columns, grain, [&](size_t x) { spread_along(mask, {x, columns, rows}, reach); });
    return mask;
}

}  // namespace surimi
