// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/pack.h"

#include <random>

#include <gtest/gtest.h>

namespace surimi {
namespace {

using Grid = std::vector<std::vector<int>>;  // rows of -1 or the chart that took the texel

Mask to_mask(const std::vector<std::vector<bool>>& cells) {
    Mask mask;
    mask.height = static_cast<int>(cells.size());
    mask.width = static_cast<int>(cells[0].size());
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (!cells[static_cast<size_t>(y)][static_cast<size_t>(x)]) continue;
            ++mask.texels;
            if (!mask.runs.empty() && mask.runs.back().row == y &&
                mask.runs.back().begin + mask.runs.back().length == x)
                ++mask.runs.back().length;
            else
                mask.runs.push_back({y, x, 1});
        }
    return mask;
}

Mask rectangle(int width, int height) {
    return to_mask(std::vector<std::vector<bool>>(static_cast<size_t>(height),
                                                  std::vector<bool>(static_cast<size_t>(width), true)));
}

/// A connected blob: a walk over the grid.
Mask blob(std::mt19937& random, int size) {
    std::vector<std::vector<bool>> cells(static_cast<size_t>(size),
                                         std::vector<bool>(static_cast<size_t>(size), false));
    size_t x = 0;
    size_t y = 0;
    while (x + 1 < cells.size() || y + 1 < cells.size()) {
        cells[y][x] = true;
        (random() % 2 == 0 && x + 1 < cells.size()) || y + 1 == cells.size() ? ++x : ++y;
    }
    cells[y][x] = true;
    return to_mask(cells);
}

/// Marks the masks on a map; fails the test when one leaves it, or two come nearer than the gutter.
void expect_gaps(const std::vector<std::vector<Mask>>& charts, const std::vector<Placement>& placements,
                 const MapSize& map, int gutter) {
    ASSERT_EQ(placements.size(), charts.size());
    Grid grid(static_cast<size_t>(map.height), std::vector<int>(static_cast<size_t>(map.width), -1));
    for (size_t i = 0; i < charts.size(); ++i) {
        for (const Mask::Run& run : charts[i][static_cast<size_t>(placements[i].turns)].runs)
            for (int k = 0; k < run.length; ++k) {
                const int x = placements[i].x + run.begin + k;
                const int y = placements[i].y + run.row;
                ASSERT_TRUE(x >= 0 && y >= 0 && x < map.width && y < map.height);
                for (int v = std::max(0, y - gutter); v <= std::min(map.height - 1, y + gutter); ++v)
                    for (int u = std::max(0, x - gutter); u <= std::min(map.width - 1, x + gutter); ++u) {
                        const int other = grid[static_cast<size_t>(v)][static_cast<size_t>(u)];
                        ASSERT_TRUE(other < 0 || other == static_cast<int>(i)) << "charts " << other << " and " << i;
                    }
                grid[static_cast<size_t>(y)][static_cast<size_t>(x)] = static_cast<int>(i);
            }
    }
}

TEST(Pack, FillsAMapThatFitsExactlyAndNoSmallerOne) {
    const std::vector<std::vector<Mask>> charts(4, {rectangle(3, 3)});
    const auto placements = pack(charts, {8, 8}, 2);
    ASSERT_TRUE(placements);
    expect_gaps(charts, *placements, {8, 8}, 2);
    EXPECT_FALSE(pack(charts, {7, 8}, 2));
    EXPECT_FALSE(pack(charts, {8, 7}, 2));
}

TEST(Pack, KeepsTheGutterBetweenBlobs) {
    std::mt19937 random(5);
    std::vector<std::vector<Mask>> charts;
    for (int i = 0; i < 120; ++i) charts.push_back({blob(random, 1 + static_cast<int>(random() % 40))});
    for (const int gutter : {1, 2, 5}) {
        const MapSize map{300, 400};
        const auto placements = pack(charts, map, gutter);
        ASSERT_TRUE(placements) << gutter;
        expect_gaps(charts, *placements, map, gutter);
    }
}

TEST(Pack, RunsLongerThanAnyTableAreTestedWhole) {
    // 700 texels: wider than one step of the run tables. A texel in the middle has to be seen.
    const std::vector<std::vector<Mask>> charts{{rectangle(700, 2)}, {rectangle(700, 1)}, {rectangle(1, 1)}};
    const MapSize map{703, 6};
    const auto placements = pack(charts, map, 1);
    ASSERT_TRUE(placements);
    expect_gaps(charts, *placements, map, 1);
}

TEST(Pack, TurnsWhatFitsOnlyTurned) {
    const std::vector<std::vector<Mask>> charts{{rectangle(10, 2), rectangle(2, 10)}};
    const auto placements = pack(charts, {3, 12}, 2);
    ASSERT_TRUE(placements);
    EXPECT_EQ((*placements)[0].turns, 1);
}

TEST(Pack, LowerBoundHolds) {
    std::mt19937 random(9);
    std::vector<std::vector<Mask>> charts;
    for (int i = 0; i < 30; ++i) charts.push_back({blob(random, 6)});
    for (int side = 20; side < 80; ++side) {
        if (!pack(charts, {side, side}, 2)) continue;
        EXPECT_LE(least_texels(charts, 2), (side + 2.0) * (side + 2.0));
        return;
    }
    FAIL() << "nothing fitted";
}

FlatChart right_triangle(double width, double height) {
    FlatChart chart;
    chart.faces = {0};
    chart.points = {{0, 0}, {width, 0}, {0, height}};
    chart.triangles = {{0, 1, 2}};
    chart.extent = {width, height};
    chart.area = chart.flat_area = 0.5 * width * height;
    return chart;
}

TEST(Footprint, HoldsEveryTexelThatTheTriangleMeetsUnderEveryTurn) {
    const MapSize map{256, 256};
    const FlatChart chart = right_triangle(13.3, 7.7);
    const TexelChart shape = to_texels(chart, 1, map);
    const std::vector<Mask> masks = make_masks(chart, shape, map);
    ASSERT_EQ(masks.size(), 4u);
    for (int turns = 0; turns < 4; ++turns) {
        const Mask& mask = masks[static_cast<size_t>(turns)];
        Grid grid(static_cast<size_t>(mask.height), std::vector<int>(static_cast<size_t>(mask.width), 0));
        for (const Mask::Run& run : mask.runs)
            for (int k = 0; k < run.length; ++k)
                grid[static_cast<size_t>(run.row)][static_cast<size_t>(run.begin + k)] = 1;
        const Vec2 a = turned(shape.points[0], shape, turns);
        const Vec2 b = turned(shape.points[1], shape, turns);
        const Vec2 c = turned(shape.points[2], shape, turns);
        for (int i = 0; i <= 400; ++i)
            for (int j = 0; i + j <= 400; ++j) {
                const Vec2 p = a + (b - a) * (i / 400.0) + (c - a) * (j / 400.0);
                ASSERT_EQ(grid.at(static_cast<size_t>(p.y)).at(static_cast<size_t>(p.x)), 1) << turns;
            }
        // Half the box, and the texels along the hypotenuse.
        EXPECT_LT(mask.texels, 0.5 * 13.3 * 7.7 + 2 * (14 + 8));
    }
}

TEST(Footprint, TinyAndThinChartsStillHaveAShape) {
    const MapSize map{1024, 1024};
    const TexelChart tiny = to_texels(right_triangle(1e-6, 2e-6), 1, map);
    EXPECT_EQ(tiny.width, 1);
    EXPECT_EQ(tiny.height, 1);
    EXPECT_GT(doubled_area(tiny.points[0], tiny.points[1], tiny.points[2]), 0.05);
    const TexelChart thin = to_texels(right_triangle(50, 1e-9), 1, map);
    EXPECT_EQ(thin.height, 1);
    EXPECT_GT(doubled_area(thin.points[0], thin.points[1], thin.points[2]), 5);
}

}  // namespace
}  // namespace surimi
