// SPDX-License-Identifier: Apache-2.0
// Surfaces on several pages.
#include "baker/unwrap/spread.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "baker/unwrap/check.h"
#include "runtime/base/error.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

Need square_metres(double area) {
    return {area, 0, 1};
}

/// Surfaces without geometry, each on a node and with a material of its own.
Scene surfaces(int count) {
    Scene scene;
    for (int s = 0; s < count; ++s) {
        Surface& surface = scene.surfaces.emplace_back();
        surface.node = s;
        surface.material = s;
    }
    return scene;
}

UnwrapSettings on_pages(int pages, int size = 64) {
    UnwrapSettings settings;
    settings.atlases = pages;
    settings.width = settings.height = size;
    return settings;
}

std::vector<double> loads(const std::vector<int>& pages, const std::vector<double>& areas) {
    std::vector<double> sums(1 + static_cast<size_t>(*std::max_element(pages.begin(), pages.end())), 0);
    for (size_t s = 0; s < areas.size(); ++s) sums[static_cast<size_t>(pages[s])] += areas[s];
    return sums;
}

TEST(Need, DensityOfInvertsTheNeed) {
    const Need need{3, 5, 7};
    EXPECT_NEAR(density_of(need, need.at(11)), 11, 1e-12);
    EXPECT_EQ(density_of(need, 6), 0) << "no room for what is always needed";
    EXPECT_EQ(density_of({0, 0, 4}, 100), 0) << "slivers alone have no density";
}

TEST(Spread, PagesDifferByNoMoreThanASurface) {
    const std::vector<double> areas{9, 1, 4, 4, 2, 7, 3, 3, 5, 1, 6, 2, 8};
    std::vector<Need> needs;
    for (const double area : areas) needs.push_back(square_metres(area));
    const std::vector<double> sums =
        loads(spread_over_pages(surfaces(static_cast<int>(areas.size())), needs, on_pages(3)), areas);
    ASSERT_EQ(sums.size(), 3u);
    // 55 square metres are 18 1/3 a page; largest first leaves no page further off than the smallest surfaces.
    for (const double sum : sums) EXPECT_NEAR(sum, 55.0 / 3, 1);
}

TEST(Spread, SurfacesOfOneNodeShareAPageWhereThatCostsNothing) {
    Scene scene = surfaces(8);
    for (size_t s = 0; s < 8; ++s) scene.surfaces[s].node = static_cast<int>(s % 2);
    const std::vector<int> pages = spread_over_pages(scene, std::vector<Need>(8, square_metres(1)), on_pages(2));
    EXPECT_EQ(pages, (std::vector<int>{0, 1, 0, 1, 0, 1, 0, 1}));
    // One material on half of the surfaces pulls as well, if less.
    for (size_t s = 0; s < 8; ++s) scene.surfaces[s].node = static_cast<int>(s);
    for (size_t s = 0; s < 8; ++s) scene.surfaces[s].material = s < 4 ? 0 : 1;
    EXPECT_EQ(spread_over_pages(scene, std::vector<Need>(8, square_metres(1)), on_pages(2)),
              (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(Spread, PagesAreNumberedByTheirFirstSurfaces) {
    const std::vector<Need> needs{square_metres(1), square_metres(2), square_metres(9), {}, square_metres(5)};
    const std::vector<int> pages = spread_over_pages(surfaces(5), needs, on_pages(2));
    EXPECT_EQ(pages, (std::vector<int>{0, 0, 1, 0, 0}));
}

TEST(Spread, ThereAreNoEmptyPages) {
    const std::vector<Need> needs{square_metres(1), {}, square_metres(2)};
    EXPECT_EQ(spread_over_pages(surfaces(3), needs, on_pages(7)), (std::vector<int>{0, 0, 1}));
    EXPECT_EQ(spread_over_pages(surfaces(3), needs, on_pages(1)), (std::vector<int>{0, 0, 0}));
}

TEST(BestMove, RelievesTheTightestPage) {
    const std::vector<Need> needs{square_metres(4), square_metres(1), square_metres(2), square_metres(3)};
    const Pages pages{{0, 0, 0, 1}, {10, 20}};
    // The pages hold 7 m2 at 10 and 3 m2 at 20 texels a metre: 703 and 1201 texels.
    const auto move = best_move(pages, needs, {});
    ASSERT_TRUE(move.has_value());
    EXPECT_EQ(*move, (Move{0, 1})) << "3 m2 stay, at 15.3; 7 m2 at 13.1";
    EXPECT_EQ(*best_move(pages, needs, {{0, 1}}), (Move{2, 1})) << "5 m2 stay, at 11.8";
    EXPECT_FALSE(best_move(pages, needs, {{0, 1}, {1, 1}, {2, 1}}).has_value());
}

TEST(BestMove, ASurfaceAloneOnAPageHoldsUpNobody) {
    const std::vector<Need> needs{square_metres(40), square_metres(1), square_metres(1)};
    const Pages pages{{0, 1, 1}, {3, 20}};
    EXPECT_EQ(tightest_page(pages, needs), 1);
    EXPECT_EQ(tightest_page({{0, 1, 2}, {3, 20, 20}}, needs), -1);
}

/// Every page's triangles as the map has them, in texels.
std::vector<std::vector<FlatTriangle>> flat_pages(const Atlas& atlas) {
    std::vector<std::vector<FlatTriangle>> pages(static_cast<size_t>(atlas.pages));
    const Vec2 size(atlas.width, atlas.height);
    for (const SurfaceUv& surface : atlas.surfaces)
        for (const auto& uv : surface.uv)
            pages.at(static_cast<size_t>(surface.page))
                .push_back({Vec2(uv[0]) * size, Vec2(uv[1]) * size, Vec2(uv[2]) * size});
    return pages;
}

Scene crates(int count, double size = 1) {
    Scene scene;
    for (int i = 0; i < count; ++i) test::add_box(scene, "Crate" + std::to_string(i), Vec3(3 * i, 0, 0), Vec3(size));
    return scene;
}

TEST(UnwrapPages, AllPagesHaveOneDensityAndNoOverlap) {
    const Scene scene = crates(7);
    const Atlas one = unwrap(scene, on_pages(1), {});
    const Atlas three = unwrap(scene, on_pages(3), {});
    EXPECT_EQ(one.pages, 1);
    ASSERT_EQ(three.pages, 3);
    EXPECT_EQ(three.width, 64);
    for (const Chart& chart : three.charts) EXPECT_EQ(chart.texels_per_metre, three.texels_per_metre);
    // Three pages have three times the texels, and the fullest has three crates in place of seven.
    EXPECT_GT(three.texels_per_metre, 1.45 * one.texels_per_metre);
    EXPECT_TRUE(three.weights.empty());
    for (const auto& triangles : flat_pages(three)) {
        EXPECT_GE(triangles.size(), 24u);
        EXPECT_TRUE(overlapping_pairs(triangles, 0, 1).empty());
    }
}

TEST(UnwrapPages, ASurfaceThatFillsAPageDoesNotHoldUpTheOthers) {
    Scene scene = crates(6);
    const uint32_t hall = test::add_box(scene, "Hall", Vec3(0), Vec3(40), true);
    const Atlas atlas = unwrap(scene, on_pages(2, 128), {});
    ASSERT_EQ(atlas.pages, 2);
    ASSERT_EQ(atlas.weights.size(), 1u);
    EXPECT_EQ(atlas.weights[0].surface, hall);
    EXPECT_EQ(atlas.weights[0].cause, DensityCause::full_page);
    EXPECT_LT(atlas.weights[0].most, 0.1);
    for (const Chart& chart : atlas.charts)
        EXPECT_NEAR(chart.texels_per_metre / atlas.texels_per_metre,
                    chart.surface == hall ? atlas.weights[0].most : 1.0, 1e-12);
    EXPECT_GT(atlas.texels_per_metre, unwrap(crates(6), on_pages(1, 128), {}).texels_per_metre * 0.99);
}

TEST(UnwrapPages, PagesOfADensityAreOfOneSize) {
    UnwrapSettings settings = on_pages(2);
    settings.texels_per_metre = 10;
    Scene scene = crates(3);
    const Atlas atlas = unwrap(scene, settings, {});
    EXPECT_EQ(atlas.pages, 2);
    EXPECT_EQ(atlas.texels_per_metre, 10);
    settings.atlases = 1;
    EXPECT_LT(atlas.width, unwrap(scene, settings, {}).width);
    for (const Chart& chart : atlas.charts) EXPECT_EQ(chart.texels_per_metre, 10);
    for (const auto& triangles : flat_pages(atlas)) EXPECT_TRUE(overlapping_pairs(triangles, 0, 1).empty());
}

TEST(UnwrapPages, ThreadsDoNotChangeABit) {
    Scene scene = crates(5);
    test::add_box(scene, "Long", {0, 5, 0}, {20, 0.3, 1});
    set_thread_count(1);
    const Atlas one = unwrap(scene, on_pages(3), {});
    set_thread_count(4);
    const Atlas four = unwrap(scene, on_pages(3), {});
    set_thread_count(0);
    EXPECT_EQ(one.texels_per_metre, four.texels_per_metre);
    for (size_t s = 0; s < one.surfaces.size(); ++s) {
        EXPECT_EQ(one.surfaces[s].uv, four.surfaces[s].uv);
        EXPECT_EQ(one.surfaces[s].page, four.surfaces[s].page);
    }
}

TEST(UnwrapPages, RefusesCountsThatMakeNoSense) {
    const Scene scene = crates(1);
    EXPECT_THROW(unwrap(scene, on_pages(0), {}), Error);
    EXPECT_THROW(unwrap(scene, on_pages(65), {}), Error);
    UnwrapSettings existing = on_pages(2);
    existing.uv = UvSource::existing;
    EXPECT_THROW(unwrap(scene, existing, {}), Error);
}

TEST(UnwrapPages, ProgressDoesNotStartAnewForEachPage) {
    std::vector<double> fractions;
    Progress progress;
    progress.report = [&](std::string_view stage, double fraction) {
        if (stage == "packing") fractions.push_back(fraction);
    };
    unwrap(crates(3), on_pages(3), progress);
    ASSERT_FALSE(fractions.empty());
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1);
}

}  // namespace
}  // namespace surimi
