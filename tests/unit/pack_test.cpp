// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/pack.h"

#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "baker/unwrap/axes.h"
#include "baker/unwrap/fit.h"
#include "baker/unwrap/round_chart.h"
#include "runtime/base/error.h"
#include "tests/support/chart_shapes.h"

namespace surimi {
namespace {

using Grid = std::vector<std::vector<int>>;  // rows of -1 or the chart that took the texel

/// A mask of what is true. Edges around every texel are an outline as well.
Mask to_mask(const std::vector<std::vector<bool>>& cells) {
    Raster raster(static_cast<int>(cells[0].size()), static_cast<int>(cells.size()));
    for (size_t y = 0; y < cells.size(); ++y)
        for (size_t x = 0; x < cells[0].size(); ++x) {
            const Vec2 centre(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
            if (cells[y][x]) raster.add_edge(centre, centre, 0);
        }
    return raster.mask();
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

/// By either rule and in every order, or nothing when one of the charts finds no place.
std::optional<std::vector<Placement>> pack(const std::vector<std::vector<Mask>>& masks, const MapSize& map,
                                           int gutter) {
    const PackCharts charts = prepare_charts(masks);
    std::optional<std::vector<Placement>> result;
    for (const PackRule rule : {PackRule::upper_end, PackRule::centre})
        for (const PackOrder order :
             {PackOrder::longer_side, PackOrder::half_perimeter, PackOrder::box, PackOrder::texels}) {
            Packing packing = pack(charts, map, gutter, {order, rule});
            if (packing.failed.empty()) result = std::move(packing.placements);
        }
    return result;
}

/// Marks the masks on a map; fails the test when one leaves it, or two come nearer than the gutter.
void expect_gaps(const std::vector<std::vector<Mask>>& charts, const std::vector<Placement>& placements,
                 const MapSize& map, int gutter) {
    ASSERT_EQ(placements.size(), charts.size());
    Grid grid(static_cast<size_t>(map.height), std::vector<int>(static_cast<size_t>(map.width), -1));
    for (size_t i = 0; i < charts.size(); ++i) {
        for (const Mask::Run& run : charts[i][static_cast<size_t>(placements[i].mask)].runs)
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
    EXPECT_EQ((*placements)[0].mask, 1);
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

Grid to_grid(const Mask& mask) {
    Grid grid(static_cast<size_t>(mask.height), std::vector<int>(static_cast<size_t>(mask.width), 0));
    for (const Mask::Run& run : mask.runs)
        for (int k = 0; k < run.length; ++k) grid[static_cast<size_t>(run.row)][static_cast<size_t>(run.begin + k)] = 1;
    return grid;
}

std::vector<Mask> masks_of(const FlatChart& chart, const TexelChart& shape, const MapSize& map) {
    return make_masks(chart_outline(chart), shape, map);
}

TEST(Footprint, HoldsEveryTexelThatTheTriangleMeetsUnderEveryTurnAndMirrored) {
    const MapSize map{256, 256};
    const FlatChart chart = right_triangle(13.3, 7.7);
    const TexelChart shape = to_texels(chart, 1, map);
    const std::vector<Mask> masks = masks_of(chart, shape, map);
    ASSERT_EQ(masks.size(), 8u);
    for (const Mask& mask : masks) {
        const Grid grid = to_grid(mask);
        const Vec2 a = turned(shape.points[0], shape, mask.turns);
        const Vec2 b = turned(shape.points[1], shape, mask.turns);
        const Vec2 c = turned(shape.points[2], shape, mask.turns);
        EXPECT_EQ(doubled_area(a, b, c) < 0, mask.turns >= mirrored);
        for (int i = 0; i <= 400; ++i)
            for (int j = 0; i + j <= 400; ++j) {
                const Vec2 p = a + (b - a) * (i / 400.0) + (c - a) * (j / 400.0);
                ASSERT_EQ(grid.at(static_cast<size_t>(p.y)).at(static_cast<size_t>(p.x)), 1) << mask.turns;
            }
        // Half the box, and the texels along the hypotenuse.
        EXPECT_LT(mask.texels, 0.5 * 13.3 * 7.7 + 2 * (14 + 8));
        for (const Mask::Square& square : mask.squares)
            for (int y = square.y; y < square.y + (1 << square.level); ++y)
                for (int x = square.x; x < square.x + (1 << square.level); ++x)
                    ASSERT_EQ(grid.at(static_cast<size_t>(y)).at(static_cast<size_t>(x)), 1);
    }
}

TEST(Footprint, EqualPosesComeOnce) {
    const MapSize map{256, 256};
    const auto count = [&](const FlatChart& chart) { return masks_of(chart, to_texels(chart, 1, map), map).size(); };
    EXPECT_EQ(count(test::rectangle_chart(9, 5)), 2u);
    EXPECT_EQ(count(test::rectangle_chart(9, 9)), 1u);
    EXPECT_EQ(count(right_triangle(9.5, 9.5)), 4u);
}

TEST(Footprint, OutlinesGiveTheTexelsThatTrianglesTouch) {
    const MapSize map{512, 512};
    for (const test::ChartSet& set : test::chart_sets()) {
        if (set.charts.size() > 100) continue;
        for (const FlatChart& chart : set.charts) {
            const TexelChart shape = to_texels(chart, 8, map);
            const Grid grid = to_grid(masks_of(chart, shape, map)[0]);
            for (const auto& t : chart.triangles) {
                const Vec2 centre = (shape.points[t[0]] + shape.points[t[1]] + shape.points[t[2]]) / 3.0;
                for (const uint32_t corner : t)
                    for (int i = 0; i <= 40; ++i) {
                        const Vec2 p = centre + (shape.points[corner] - centre) * (i / 40.0);
                        ASSERT_EQ(grid.at(static_cast<size_t>(p.y)).at(static_cast<size_t>(p.x)), 1) << set.name;
                    }
            }
        }
    }
}

TEST(Footprint, HolesStayOpen) {
    const MapSize map{256, 256};
    const FlatChart ring = test::arc_chart(20, 40, 2 * pi - 0.3);
    const Grid grid = to_grid(masks_of(ring, to_texels(ring, 1, map), map)[0]);
    EXPECT_EQ(grid.at(40).at(40), 0);
}

TEST(Footprint, CellsHoldTheirTexels) {
    const MapSize map{256, 256};
    const FlatChart chart = test::arc_chart(20, 40, 2);
    const TexelChart shape = to_texels(chart, 1, map, {1, 0}, 8);
    EXPECT_EQ(shape.width % 8, 0);
    EXPECT_EQ(shape.height % 8, 0);
    const Grid texels = to_grid(masks_of(chart, shape, map)[0]);
    const Grid cells = to_grid(make_masks(chart_outline(chart), shape, map, 8)[0]);
    Grid expected(cells.size(), std::vector<int>(cells[0].size(), 0));
    for (size_t y = 0; y < texels.size(); ++y)
        for (size_t x = 0; x < texels[0].size(); ++x) expected.at(y / 8).at(x / 8) |= texels[y][x];
    EXPECT_EQ(cells, expected);
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

TEST(Pack, SmallChartsGoIntoHoles) {
    std::vector<std::vector<bool>> ring(20, std::vector<bool>(20, true));
    for (size_t y = 4; y < 16; ++y)
        for (size_t x = 4; x < 16; ++x) ring[y][x] = false;
    const std::vector<std::vector<Mask>> charts{{to_mask(ring)}, {rectangle(8, 8)}};
    const auto placements = pack(charts, {20, 20}, 2);
    ASSERT_TRUE(placements);
    expect_gaps(charts, *placements, {20, 20}, 2);
    EXPECT_FALSE(pack(charts, {20, 20}, 3));
}

FitRequest request_of(const std::vector<FlatChart>& charts, const std::vector<double>& factors, int mips) {
    static const Progress quiet;
    return {charts, factors, 2, quiet, mips};
}

Layout fitted(const std::vector<FlatChart>& charts, const MapSize& map, int mips = 0) {
    return fit_to_map(request_of(charts, std::vector<double>(charts.size(), 1), mips), map);
}

TEST(FitToMap, ALongStripGoesAlongTheDiagonal) {
    const Layout layout = fitted({test::rectangle_chart(20, 1)}, {256, 256});
    // Upright it would end at 256 / 20; along the diagonal, (20 + 1) / sqrt(2) is as long as the map.
    EXPECT_GT(layout.texels_per_metre, 0.97 * 256 * std::sqrt(2.0) / 21);
    const Layout wide = fitted({test::rectangle_chart(20, 1)}, {512, 64});
    EXPECT_GT(wide.texels_per_metre, 0.99 * 512 / 20);
}

TEST(FitToMap, FourSquaresFillTheMapToWithinAHalfPercent) {
    const std::vector<FlatChart> charts(4, test::rectangle_chart(1, 1));
    EXPECT_GT(fitted(charts, {514, 514}).texels_per_metre, 0.995 * 256);
}

std::vector<FlatChart> set_named(const std::string& name) {
    for (test::ChartSet& set : test::chart_sets())
        if (set.name == name) return std::move(set.charts);
    ADD_FAILURE() << name;
    return {};
}

TEST(FitToMap, GivesTheSamePlacesAgain) {
    const std::vector<FlatChart> charts = set_named("40 arcs");
    const Layout one = fitted(charts, {256, 256});
    const Layout other = fitted(charts, {256, 256});
    EXPECT_EQ(one.texels_per_metre, other.texels_per_metre);
    for (size_t i = 0; i < charts.size(); ++i) {
        EXPECT_EQ(one.placements[i].x, other.placements[i].x);
        EXPECT_EQ(one.placements[i].y, other.placements[i].y);
        EXPECT_EQ(one.placements[i].turns, other.placements[i].turns);
    }
}

TEST(RoundChart, AcceptsAndKeepsMirroredCharts) {
    const MapSize map{300, 200};
    const FlatChart chart = test::arc_chart(20, 40, 2);
    const TexelChart shape = to_texels(chart, 1, map);
    for (int turns = 0; turns < 8; ++turns) {
        const RoundedChart rounded = round_chart(chart, shape, {7, 5, turns, 0}, map);
        EXPECT_TRUE(rounded.bad.empty() && rounded.overlapping.empty()) << turns;
        const auto& t = chart.triangles[0];
        const double area = doubled_area(rounded.points[t[0]], rounded.points[t[1]], rounded.points[t[2]]);
        EXPECT_EQ(area < 0, turns >= mirrored);
    }
}

/// The chart that touches each texel of a mip level, in its final coordinates; -1 for none. Fails where two do.
Grid owners_on_level(const std::vector<FlatChart>& charts, const Layout& layout, int level) {
    const int side = 1 << level;
    Grid grid(static_cast<size_t>(layout.map.height / side),
              std::vector<int>(static_cast<size_t>(layout.map.width / side), -1));
    for (size_t i = 0; i < charts.size(); ++i) {
        const Placement& at = layout.placements[i];
        for (const Mask& mask : masks_of(charts[i], layout.shapes[i], layout.map)) {
            if (mask.turns != at.turns) continue;
            for (const Mask::Run& run : mask.runs)
                for (int x = at.x + run.begin; x < at.x + run.begin + run.length; ++x) {
                    int& owner =
                        grid.at(static_cast<size_t>((at.y + run.row) / side)).at(static_cast<size_t>(x / side));
                    EXPECT_TRUE(owner < 0 || owner == static_cast<int>(i)) << "level " << level;
                    owner = static_cast<int>(i);
                }
        }
    }
    return grid;
}

TEST(FitToMap, GuttersSurviveTheMipLevelsAskedFor) {
    const std::vector<FlatChart> charts = set_named("40 arcs");
    constexpr int mips = 3;
    const Layout layout = fitted(charts, {512, 512}, mips);
    for (int level = 0; level <= mips; ++level) {
        const Grid grid = owners_on_level(charts, layout, level);
        const size_t gutter = level == 0 ? 2 : 1;
        size_t seen = 0;
        for (size_t y = 0; y < grid.size(); ++y)
            for (size_t x = 0; x < grid[y].size(); ++x) {
                if (grid[y][x] < 0) continue;
                ++seen;
                for (size_t v = y; v <= std::min(y + gutter, grid.size() - 1); ++v)
                    for (size_t u = x - std::min(x, gutter); u <= std::min(x + gutter, grid[y].size() - 1); ++u)
                        ASSERT_TRUE(grid[v][u] < 0 || grid[v][u] == grid[y][x]) << "level " << level;
            }
        EXPECT_GT(seen, grid.size());
    }
    EXPECT_LT(layout.texels_per_metre, fitted(charts, {512, 512}).texels_per_metre);
}

std::string refusal(const std::vector<FlatChart>& charts, const MapSize& map, int mips) {
    try {
        fitted(charts, map, mips);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

TEST(FitToMap, SaysWhenMipLevelsLeaveNoRoom) {
    const std::vector<FlatChart> charts(100, test::rectangle_chart(1, 1));
    fitted(charts, {64, 64});
    // 10 x 10 charts of 8 texels with 8 between them.
    const std::string full = refusal(charts, {64, 64}, 3);
    EXPECT_NE(full.find("152x152"), std::string::npos) << full;
    EXPECT_NE(full.find("3 mip levels"), std::string::npos) << full;
    const std::string odd = refusal(charts, {500, 500}, 3);
    EXPECT_NE(odd.find("multiples of 8"), std::string::npos) << odd;
}

}  // namespace
}  // namespace surimi
