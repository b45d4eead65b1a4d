// SPDX-License-Identifier: Apache-2.0
#include "baker/post/rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/support/random.h"

namespace surimi {
namespace {

constexpr int width = 23, height = 17;

/// Calls visit(x, y) for the map's texels within `rings` of (x0, y0); true when some are beyond the map's end.
template <class Visit>
bool for_square(int x0, int y0, int rings, const Visit& visit) {
    for (int y = std::max(0, y0 - rings); y <= std::min(height - 1, y0 + rings); ++y)
        for (int x = std::max(0, x0 - rings); x <= std::min(width - 1, x0 + rings); ++x) visit(y * width + x);
    return x0 < rings || y0 < rings || x0 + rings >= width || y0 + rings >= height;
}

TEST(Rim, SpreadsAMaskByRingsOfEightNeighbours) {
    Random random{3};
    std::vector<uint8_t> mask(width * height);
    for (uint8_t& m : mask) m = random.next() < 0.02;
    for (const int rings : {1, 2, 5}) {
        const std::vector<uint8_t> found = spread(mask, width, rings);
        for (int i = 0; i < width * height; ++i) {
            bool expected = false;
            for_square(i % width, i / width, rings, [&](int j) { expected |= mask[static_cast<size_t>(j)] != 0; });
            EXPECT_EQ(found[static_cast<size_t>(i)], expected) << i << " " << rings;
        }
    }
}

TEST(Rim, IsWhereAnotherKindOrTheMapsEndIsNear) {
    std::vector<uint64_t> kinds(width * height, 7);
    for (int y = 6; y < 9; ++y)
        for (int x = 11; x < 14; ++x) kinds[static_cast<size_t>(y * width + x)] = 8;
    for (const int rings : {1, 2, 3}) {
        const std::vector<uint8_t> found = rim(kinds, width, rings);
        for (int i = 0; i < width * height; ++i) {
            bool expected = false;
            const auto is_other = [&](int j) {
                expected |= kinds[static_cast<size_t>(j)] != kinds[static_cast<size_t>(i)];
            };
            expected |= for_square(i % width, i / width, rings, is_other);
            EXPECT_EQ(found[static_cast<size_t>(i)], expected) << i << " " << rings;
        }
    }
}

}  // namespace
}  // namespace surimi
