// SPDX-License-Identifier: Apache-2.0
// The judge of unwraps, judged: it must see every fault, and none where there is none.
#include "tests/support/atlas_judge.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/single_cover.h"

namespace surimi::test {
namespace {

constexpr int size = 64;

struct Case {
    Scene scene;
    Atlas atlas;
};

/// Charts of triangles in texels, each flattened as it lies in space.
Case flat_charts(const std::vector<std::vector<std::array<Vec2, 3>>>& charts) {
    Case some;
    some.atlas.width = some.atlas.height = size;
    some.atlas.gutter = 2;
    some.scene.surfaces.resize(1);
    some.scene.surfaces[0].name = "flat";
    some.atlas.surfaces.resize(1);
    for (const auto& chart : charts) {
        for (const auto& triangle : chart) {
            const auto first = static_cast<uint32_t>(some.scene.surfaces[0].positions.size());
            some.scene.surfaces[0].triangles.push_back({first, first + 1, first + 2});
            std::array<Vec2f, 3> uv;
            for (size_t k = 0; k < 3; ++k) {
                some.scene.surfaces[0].positions.emplace_back(triangle[k], 0);
                uv[k] = Vec2f(triangle[k] / static_cast<double>(size));
            }
            some.atlas.surfaces[0].uv.push_back(uv);
            some.atlas.surfaces[0].chart.push_back(static_cast<uint32_t>(some.atlas.charts.size()));
        }
        some.atlas.charts.push_back({0, 1});
    }
    return some;
}

std::vector<std::array<Vec2, 3>> square(double x, double y, double side) {
    const Vec2 a(x, y), b(x + side, y), c(x + side, y + side), d(x, y + side);
    return {{a, b, c}, {a, c, d}};
}

bool has_fault(const Case& some, const std::string& kind) {
    const std::vector<std::string> faults = faults_of(some.scene, some.atlas);
    return std::any_of(faults.begin(), faults.end(), [&](const std::string& text) { return text.starts_with(kind); });
}

bool is_fit(const Case& some) {
    return faults_of(some.scene, some.atlas).empty();
}

TEST(AtlasJudge, SquaresWithAGutterBetweenAreFit) {
    EXPECT_TRUE(is_fit(flat_charts({square(4, 4, 10), square(16, 4, 10)})));
}

TEST(AtlasJudge, ANarrowGutterIsSeen) {
    EXPECT_TRUE(has_fault(flat_charts({square(4, 4, 10), square(15, 4, 10)}), "gutter"));
    EXPECT_TRUE(has_fault(flat_charts({square(15, 15, 10), square(4, 4, 10)}), "gutter"));  // corner to corner
    EXPECT_TRUE(has_fault(flat_charts({square(4, 4, 10.5), square(14.75, 4, 10)}), "texel of two charts"));
}

TEST(AtlasJudge, AMirroredChartIsFitAndAFlippedTriangleIsNot) {
    Case some = flat_charts({square(4, 4, 10)});
    for (auto& uv : some.atlas.surfaces[0].uv) std::swap(uv[1], uv[2]);
    EXPECT_TRUE(is_fit(some));
    std::swap(some.atlas.surfaces[0].uv[0][1], some.atlas.surfaces[0].uv[0][2]);
    EXPECT_TRUE(has_fault(some, "flipped"));
}

TEST(AtlasJudge, UnmappedTrianglesAreSeen) {
    Case some = flat_charts({square(4, 4, 10)});
    auto& uv = some.atlas.surfaces[0].uv[0];
    const std::array<Vec2f, 3> good = uv;
    uv[2] = (uv[0] + uv[1]) / 2.0f;
    EXPECT_TRUE(has_fault(some, "no area"));
    for (const float bad : {NAN, INFINITY, -0.25f, 1.25f, 0.1f}) {
        uv = good;
        uv[2].x = bad;
        EXPECT_TRUE(has_fault(some, "uv off the grid or the map")) << bad;
    }
    some.atlas.surfaces[0].uv.pop_back();
    EXPECT_TRUE(has_fault(some, "no uv for a surface"));
    EXPECT_TRUE(has_fault({some.scene, {}}, "no triangle is mapped"));
}

TEST(AtlasJudge, AChartOfAnotherSurfaceIsSeen) {
    Case some = flat_charts({square(4, 4, 10)});
    some.atlas.charts[0].surface = 1;
    EXPECT_TRUE(has_fault(some, "wrong chart"));
}

TEST(AtlasJudge, OverlapsAreSeen) {
    EXPECT_TRUE(has_fault(flat_charts({square(4, 4, 10), square(13, 13, 10)}), "overlap"));
    EXPECT_TRUE(has_fault(flat_charts({square(4, 4, 20), square(10, 10, 4)}), "overlap"));  // no edges cross
    EXPECT_TRUE(has_fault(flat_charts({square(4, 4, 10), square(4, 4, 10)}), "overlap"));   // all edges in common
    auto one_chart = square(4, 4, 10);
    one_chart.push_back({Vec2(5, 8), Vec2(9, 8), Vec2(9, 12)});
    EXPECT_TRUE(has_fault(flat_charts({one_chart}), "overlap"));
}

TEST(AtlasJudge, ATurnTwiceAroundAVertexIsSeen) {
    const auto fan = [](int triangles, int turns) {
        std::vector<std::array<Vec2, 3>> chart;
        const auto rim = [&](int i) {
            const double angle = 2 * pi * turns * (i % triangles) / triangles;
            return glm::round(Vec2(32) + 20.0 * Vec2(std::cos(angle), std::sin(angle)));
        };
        for (int i = 0; i < triangles; ++i) chart.push_back({Vec2(32), rim(i), rim(i + 1)});
        return chart;
    };
    EXPECT_TRUE(is_fit(flat_charts({fan(7, 1)})));
    EXPECT_TRUE(has_fault(flat_charts({fan(13, 2)}), "overlap"));
}

TEST(AtlasJudge, SlitsAndTJunctionsAreFit) {
    auto chart = square(4, 4, 16);
    for (const auto& triangle : square(20, 4, 8)) chart.push_back(triangle);   // half of the first one's side
    for (const auto& triangle : square(20, 12, 8)) chart.push_back(triangle);  // the other half
    chart.push_back({Vec2(28, 20), Vec2(36, 20), Vec2(36, 28)});               // touches in a corner
    EXPECT_TRUE(is_fit(flat_charts({chart})));
}

/// Open triangles, counter-clockwise, are disjoint when an edge of one has the other behind it.
bool do_share_area(const GridTriangle& a, const GridTriangle& b) {
    for (const auto& [t, other] : {std::pair(a, b), std::pair(b, a)})
        for (size_t k = 0; k < 3; ++k) {
            const auto is_behind = [&](const GridPoint& p) { return doubled_area(t[k], t[(k + 1) % 3], p) <= 0; };
            if (std::all_of(other.begin(), other.end(), is_behind)) return false;
        }
    return true;
}

TEST(SingleCover, AgreesWithComparingAllPairs) {
    std::mt19937 random(1);
    size_t fit = 0, crowded = 0;
    for (int round = 0; round < 1200; ++round) {
        const auto width = static_cast<uint32_t>(3 + round % 12);  // on few points, edges and corners meet often
        const auto any = [&] { return static_cast<int64_t>(random() % width); };
        std::vector<GridTriangle> triangles;
        for (int tries = 0; tries < 40; ++tries) {
            GridTriangle t;
            for (GridPoint& p : t) p = {any(), any()};
            if (doubled_area(t[0], t[1], t[2]) <= 0) continue;
            const bool is_free = std::none_of(triangles.begin(), triangles.end(),
                                              [&](const GridTriangle& other) { return do_share_area(t, other); });
            auto with = triangles;
            with.push_back(t);
            ASSERT_EQ(find_double_cover(with).empty(), is_free) << "round " << round << ", try " << tries;
            if (is_free) triangles = with;
            (is_free ? fit : crowded) += 1;
        }
    }
    EXPECT_GT(fit, 1000u);
    EXPECT_GT(crowded, 1000u);
}

TEST(StretchOfCharts, IsThatOfTheFormula) {
    Case some = flat_charts({square(4, 4, 10), square(20, 4, 10)});
    some.atlas.charts[0].texels_per_metre = 1;
    some.atlas.charts[1].texels_per_metre = 2;
    std::vector<Stretch> stretches = stretches_of(some.scene, some.atlas);
    ASSERT_EQ(stretches.size(), 2u);
    EXPECT_NEAR(stretches[0].dirichlet, 4, 1e-12);
    EXPECT_NEAR(stretches[0].lowest_density, 1, 1e-12);
    EXPECT_NEAR(stretches[1].dirichlet, 2 * 0.25 + 2 * 4, 1e-12);
    EXPECT_NEAR(stretches[1].lowest_density, 0.5, 1e-12);
    for (Vec3& p : some.scene.surfaces[0].positions) p = Vec3(p.x, 0.6 * 1.25 * p.y, 0.8 * 1.25 * p.y);
    stretches = stretches_of(some.scene, some.atlas);
    EXPECT_NEAR(stretches[0].dirichlet, 1 + 1 + 0.8 * 0.8 + 1.25 * 1.25, 1e-12);
    EXPECT_NEAR(stretches[0].lowest_density, 0.8, 1e-12);
}

}  // namespace
}  // namespace surimi::test
