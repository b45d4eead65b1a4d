// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace surimi {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// All texels of a tile, numbered by rows, with values of their centres.
struct Tile {
    TileGrid grid{};
    std::vector<double> values;

    template <class Value>
    explicit Tile(const Value& value) {
        for (int y = 0; y < tile_size; ++y)
            for (int x = 0; x < tile_size; ++x) {
                grid[values.size()] = static_cast<int16_t>(values.size());
                values.push_back(value(x, y));
            }
    }
    Vec2 at(int x, int y) const { return second_differences(grid, values, x, y); }
    size_t index(int x, int y) const { return static_cast<size_t>(y * tile_size + x); }
    void remove(int x, int y) { grid[index(x, y)] = -1; }
};

/// By how much the average over the texel at (x, y) differs from the value at its centre.
template <class Value>
double off_by(const Value& value, double x, double y) {
    constexpr int side = 500;
    double sum = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) sum += value(x - 0.5 + (i + 0.5) / side, y - 0.5 + (j + 0.5) / side);
    return sum / (side * side) - value(x, y);
}

TEST(Footprint, AverageOfAParabolaIsOffByA24thOfItsSecondDifferences_M56) {
    const auto value = [](double x, double y) {
        return 0.3 + 0.02 * x - 0.01 * y + 0.004 * x * x + 0.001 * y * y + 0.003 * x * y;
    };
    const Tile tile(value);
    for (int y = 0; y < tile_size; ++y)
        for (int x = 0; x < tile_size; ++x) {
            EXPECT_NEAR(tile.at(x, y).x, 0.008, 1e-14) << "at the tile's ends as well";
            EXPECT_NEAR(tile.at(x, y).y, 0.002, 1e-14);
        }
    EXPECT_NEAR(off_by(value, 3, 4), (0.008 + 0.002) / 24, 1e-8);
    EXPECT_GE(footprint_error(tile.at(3, 4)), off_by(value, 3, 4)) << "on the safe side of it";
    EXPECT_LE(footprint_error(tile.at(3, 4)), 3 * off_by(value, 3, 4));
}

TEST(Footprint, AverageOfAKinkIsOffByAnEighthOfItsSecondDifferenceAtMost_M56) {
    for (const double edge : {-0.4, -0.2, 0.0, 0.3, 0.5}) {
        const auto value = [&](double x, double) { return 0.1 * std::max(0.0, x - 3 - edge); };
        const Tile tile(value);
        double second = 0, off = 0;  // of the two texels between whose centres the kink lies
        for (const int x : {2, 3, 4}) {
            second = std::max(second, tile.at(x, 0).x);
            off = std::max(off, std::abs(off_by(value, x, 0)));
        }
        EXPECT_LE(off, 0.1 / 8 + 1e-9);
        EXPECT_LE(off, 1.3 * footprint_error({second, 0}));
    }
}

TEST(Footprint, CurvaturesOfOppositeSignsDoNotCancel_M56) {
    const Tile saddle([](double x, double y) { return 0.5 + 0.01 * x * x - 0.01 * y * y; });
    const Tile bowl([](double x, double y) { return 0.5 + 0.01 * x * x + 0.01 * y * y; });
    EXPECT_GT(footprint_error(saddle.at(3, 3)), 0);
    EXPECT_NEAR(footprint_error(saddle.at(3, 3)), footprint_error(bowl.at(3, 3)), 1e-14);
}

TEST(Footprint, TakesTheRowInWhichTheTexelIsInTheMiddleElseAtAnEnd) {
    Tile tile([](int x, int) { return x == 2 ? 1.0 : 0.0; });
    EXPECT_EQ(tile.at(2, 0).x, 2);
    EXPECT_EQ(tile.at(0, 0).x, 1) << "0 0 1";
    EXPECT_EQ(tile.at(7, 0).x, 0);
    tile.remove(1, 0);
    EXPECT_EQ(tile.at(2, 0).x, 1) << "1 0 0 in place of 0 1 0";
    EXPECT_EQ(tile.at(0, 0).x, infinite) << "no neighbour";
    EXPECT_EQ(tile.at(0, 1).x, 1) << "other rows do not care";
    tile.remove(4, 0);
    EXPECT_EQ(tile.at(2, 0).x, 1) << "1 0: of a pair the difference";
}

TEST(Footprint, NothingIsKnownOfATexelWithoutNeighbours) {
    Tile tile([](int, int) { return 0.5; });
    for (int y = 0; y < tile_size; ++y)
        for (int x = 0; x < tile_size; ++x)
            if (x != 4 || y != 4) tile.remove(x, y);
    EXPECT_EQ(tile.at(4, 4).x, infinite);
    EXPECT_EQ(tile.at(4, 4).y, infinite);
    EXPECT_EQ(footprint_error(tile.at(4, 4)), infinite);
}

TEST(Footprint, UnknownValuesMakeItInfiniteNeverNaN) {
    // Every pattern of unknown neighbours in a row.
    for (int unknown = 1; unknown < 1 << tile_size; ++unknown) {
        const Tile tile([&](int x, int) { return unknown >> x & 1 ? infinite : 0.5; });
        for (int x = 0; x < tile_size; ++x) {
            if (unknown >> x & 1) continue;
            const double error = footprint_error(tile.at(x, 0));
            const bool has_neighbour = (x > 0 && !(unknown >> (x - 1) & 1)) || (x < 7 && !(unknown >> (x + 1) & 1));
            EXPECT_EQ(error, has_neighbour ? 0 : infinite) << unknown << ' ' << x;
        }
    }
}

}  // namespace
}  // namespace surimi
