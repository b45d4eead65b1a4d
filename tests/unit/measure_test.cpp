// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/measure.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/uv_scenes.h"

namespace surimi::test {
namespace {

constexpr double rounding = 1e-6;  // UVs are float

UnwrapNumbers numbers_of(const Scene& scene) {
    return measure(scene, atlas_of(scene));
}

Scene one_quad(const Texels4& rectangle) {
    Scene scene;
    scene.surfaces.push_back(uv_quad("quad", unit_square(0), rectangle));
    return scene;
}

TEST(Measure, AnIsometricSquareIsPerfect) {
    const UnwrapNumbers n = numbers_of(one_quad({8, 8, 40, 40}));
    EXPECT_EQ(n.triangles, 2u);
    EXPECT_EQ(n.charts, 1u);
    EXPECT_EQ(n.single_triangle_charts + n.mirrored_charts + n.degenerate_triangles + n.collapsed_triangles, 0u);
    EXPECT_DOUBLE_EQ(n.area, 1);
    EXPECT_NEAR(n.l2_stretch, 1, rounding);
    EXPECT_NEAR(n.linf_stretch, 1, rounding);
    EXPECT_NEAR(n.symmetric_dirichlet, 4, rounding);
    EXPECT_NEAR(n.angle_mean, 1, rounding);
    EXPECT_NEAR(n.area_p99, 1, rounding);
    for (const double density : {n.density_p1, n.density_p50, n.density_p99}) EXPECT_NEAR(density, 32, 32 * rounding);
    EXPECT_NEAR(n.area_share, 0.25, rounding);
    EXPECT_NEAR(n.touched_share, 0.25, rounding);
    EXPECT_NEAR(n.density_efficiency, 0.25, rounding);
    EXPECT_EQ(n.seam_length, 0);
}

TEST(Measure, ASquareSquashedToHalfItsHeight) {
    const UnwrapNumbers n = numbers_of(one_quad({8, 8, 40, 24}));
    // s1 = sqrt 2 across, s2 = 1 / sqrt 2 along, when the area is kept.
    EXPECT_NEAR(n.l2_stretch, std::sqrt(1.25), rounding);
    EXPECT_NEAR(n.linf_stretch, std::sqrt(2.0), rounding);
    EXPECT_NEAR(n.symmetric_dirichlet, 5, rounding);
    EXPECT_NEAR(n.angle_mean, 2, rounding);
    EXPECT_NEAR(n.area_mean, 1, rounding);
    EXPECT_NEAR(n.density_p50, 16, 16 * rounding);
    EXPECT_NEAR(n.density_efficiency, 16.0 * 16 / (64 * 64), rounding);
}

TEST(Measure, TheWorstPlaceDecidesTheEfficiency) {
    Scene scene = one_quad({8, 8, 24, 24});
    scene.surfaces.push_back(uv_quad("coarse", unit_square(5), {30, 8, 38, 16}));
    const UnwrapNumbers n = numbers_of(scene);
    EXPECT_NEAR(n.density_p1, 8, 8 * rounding);
    EXPECT_NEAR(n.density_p99, 16, 16 * rounding);
    EXPECT_NEAR(n.density_efficiency, 2 * 8.0 * 8 / (64 * 64), rounding);
}

TEST(Measure, SeamsShowWhereTheSurfaceIsSmooth) {
    const auto folded = [](double angle) {
        Scene scene = one_quad({8, 8, 24, 24});
        const Vec3 up(std::cos(angle), 0, std::sin(angle));
        scene.surfaces.push_back(
            uv_quad("next", {Vec3(1, 0, 0), Vec3(1, 0, 0) + up, Vec3(1, 1, 0) + up, Vec3(1, 1, 0)}, {30, 8, 46, 24}));
        return numbers_of(scene);
    };
    const UnwrapNumbers flat = folded(0);
    EXPECT_NEAR(flat.seam_length, 1, rounding);
    EXPECT_NEAR(flat.smooth_seam_length, 1, rounding);
    EXPECT_NEAR(flat.smooth_seam_over_root_area, 1 / std::sqrt(2.0), rounding);
    EXPECT_EQ(folded(39 * pi / 180).smooth_seam_length, 1);
    const UnwrapNumbers bent = folded(41 * pi / 180);
    EXPECT_NEAR(bent.seam_length, 1, rounding);
    EXPECT_NEAR(bent.seam_over_root_area, 1 / std::sqrt(2.0), rounding);
    EXPECT_EQ(bent.smooth_seam_length, 0);
}

TEST(Measure, SidesOfAChartAreItsSeamsAndTheRimOfTheMesh) {
    Scene scene = one_quad({8, 8, 24, 24});
    scene.surfaces.push_back(uv_quad("next", unit_square(1), {30, 8, 46, 24}));
    const std::vector<ChartSide> sides = chart_sides(scene, atlas_of(scene));
    EXPECT_EQ(sides.size(), 8u);  // of two quads, not the diagonals
    size_t smooth = 0;
    for (const ChartSide& side : sides) smooth += side.is_smooth;
    EXPECT_EQ(smooth, 2u);
}

TEST(Measure, CountsMirroredSingleAndDegenerate) {
    Scene scene = one_quad({24, 8, 8, 24});
    Surface single = uv_quad("single", unit_square(5), {30, 8, 46, 24});
    single.triangles.pop_back();
    scene.surfaces.push_back(single);
    Surface needle = uv_quad("needle", unit_square(9), {30, 30, 46, 46});
    needle.triangles.pop_back();
    needle.positions[2] = Vec3(9.5, 1e-14, 0);
    scene.surfaces.push_back(needle);
    Surface lost = uv_quad("lost", unit_square(13), {50, 50, 50, 50});
    scene.surfaces.push_back(lost);
    const UnwrapNumbers n = numbers_of(scene);
    EXPECT_EQ(n.triangles, 6u);
    EXPECT_EQ(n.charts, 3u);  // the needle's has nothing to show
    EXPECT_EQ(n.mirrored_charts, 1u);
    EXPECT_EQ(n.single_triangle_charts, 1u);
    EXPECT_EQ(n.degenerate_triangles, 1u);
    EXPECT_EQ(n.collapsed_triangles, 2u);
    EXPECT_NEAR(n.l2_stretch, 1, rounding);
}

TEST(Measure, SharesAreThoseOfAllPages) {
    const Scene scene = two_quads(2);
    Atlas atlas = atlas_of(scene);
    const UnwrapNumbers one = measure(scene, atlas);
    atlas.pages = 2;
    atlas.surfaces[1].page = 1;
    const UnwrapNumbers two = measure(scene, atlas);
    EXPECT_NEAR(two.area_share, one.area_share / 2, rounding);
    EXPECT_NEAR(two.touched_share, one.touched_share / 2, rounding);
    EXPECT_NEAR(two.density_efficiency, one.density_efficiency / 2, rounding);
}

TEST(Measure, NothingIsNaNForNothing) {
    const UnwrapNumbers n = measure({}, {});
    for (const double value : {n.l2_stretch, n.symmetric_dirichlet, n.area_share, n.touched_share, n.density_efficiency,
                               n.smooth_seam_over_root_area, n.density_p50, n.angle_mean})
        EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace surimi::test
