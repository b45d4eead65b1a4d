// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/texel_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "baker/gather/block_light.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr int size = 16;

/// A floor whose monitor a sheet hides in part, its texels, and block (0, 0), (0, 1), (1, 0) or (1, 1) of them.
struct Stage {
    Scene scene;
    Atlas atlas;
    Texels texels;

    Stage() {
        const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
        test::add_quad(scene, "Sheet", {-1.5, 1.2, 3}, {0.07, 1.2, 3}, {0.12, 1.2, -3}, {-1.5, 1.2, -3});
        atlas = test::whole_map_atlas(scene, floor, size);
        Scene floor_only = scene;
        for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
            if (s != floor) floor_only.surfaces[s].triangles.clear();
        texels = find_texels(floor_only, atlas);
    }
};

struct Sight {
    explicit Sight(const GatherSettings& settings)
        : rays(stage.scene),
          silhouettes(find_silhouettes(stage.scene, rays)),
          setup(set_up(stage.scene, rays, silhouettes, 0, settings)) {
        std::vector<Vec3> corners;
        for (const double x : {-2.0, 2.0})
            for (const double z : {-2.0, 2.0}) corners.push_back(Vec3(x, 0, z) - rays.center());
        for (Vec3& corner : corners) corner.y += 1e-5;
        look_from(sight, setup, corners, 0.25);
    }
    TexelSurface surface(size_t x, size_t y) const {
        return {stage.scene, stage.atlas, stage.texels, stage.texels.texels[y * size + x]};
    }
    /// From 32 x 32 exact points.
    double truth(const TexelSurface& of) {
        MonitorSetup exact = set_up(stage.scene, rays, silhouettes, 0, {.is_exact = true});
        double seen = 0, all = 0;
        for (int i = 0; i < 1024; ++i) {
            const PointLight light =
                light_at(exact, sight, of.sample((i % 32 + 0.5) / 32, (i / 32 + 0.5) / 32), {1}, work);
            seen += light.shadowed;
            all += light.unshadowed;
        }
        return seen / all;
    }

    Stage stage;
    RayScene rays;
    Silhouettes silhouettes;
    MonitorSetup setup;
    BlockSight sight;
    PointWorkspace work;
};

TEST(TexelLight, MiddlesOfCellsApproachTheAverageWithTheirSquare_M56) {
    Sight sight({.is_exact = true});
    double of_center = 0;
    for (const int side : {1, 2, 4}) {
        double worst = 0;
        for (size_t x = 8; x < 14; ++x) {  // in the penumbra and out of it; (7, 7) and others lie on the diagonal
            const TexelSurface surface = sight.surface(x, 2);
            ASSERT_EQ(surface.pieces().size(), 1u);
            const TexelLight light = average_over_cells(sight.setup, sight.sight, surface, side, 1, sight.work);
            EXPECT_EQ(light.points, static_cast<size_t>(side * side));
            EXPECT_GE(light.spread, 0);
            EXPECT_LE(light.spread, 1);
            if (side == 1) {
                EXPECT_EQ(light.spread, 0) << "one point differs from nothing";
            }
            worst = std::max(worst, std::abs(light.light.visibility() - sight.truth(surface)));
        }
        if (side == 1) of_center = worst;
        if (side == 4) {
            EXPECT_LT(worst, of_center / 5) << "16 but for kinks";
        }
    }
    EXPECT_GT(of_center, 1e-3);
}

TEST(TexelLight, PiecesCountByTheirShares) {
    Sight sight({.is_exact = true});
    const TexelSurface whole = sight.surface(9, 6);
    EXPECT_EQ(average_over_cells(sight.setup, sight.sight, whole, 4, 1, sight.work).points, 16u);
    const TexelSurface halves = sight.surface(9, 9);
    ASSERT_EQ(halves.pieces().size(), 2u) << "the quad's diagonal";
    const TexelLight light = average_over_cells(sight.setup, sight.sight, halves, 4, 1, sight.work);
    EXPECT_EQ(light.points, 18u) << "3 x 3 in each";
    EXPECT_NEAR(light.light.visibility(), sight.truth(halves), 3e-3);
}

TEST(TexelLight, RefinesUntilTheErrorIsReached) {
    for (const double error : {0.02, 0.004, 0.001}) {
        Sight sight({.error = error});
        for (size_t x = 0; x < size; ++x) {
            const TexelSurface surface = sight.surface(x, 3);
            const SurfacePoint center = surface.center();
            const PointLight light = light_at(sight.setup, sight.sight, center, {1}, sight.work);
            const TexelLight found =
                refined(sight.setup, sight.sight, surface, {light, INFINITY, false, true, false}, 1, sight.work);
            EXPECT_NEAR(found.light.visibility(), sight.truth(surface), error) << x;
            EXPECT_LE(found.light.error, error) << x;
            const bool is_by_rays = found.light.method == TexelMethod::monte_carlo;
            EXPECT_GE(found.points, is_by_rays ? 2u : 3u) << "the centre and one of each piece at least, or rays";
        }
    }
}

TEST(TexelLight, RaysKeepTheIrradianceOfTheClosedForm_M6) {
    Sight sight({.error = 0.004, .method = Method::monte_carlo});
    const TexelSurface surface = sight.surface(9, 3);
    const TexelLight light = by_rays(sight.setup, surface, 0.5, 0.001, 3);
    EXPECT_EQ(light.light.unshadowed, 0.5);
    EXPECT_EQ(light.light.method, TexelMethod::monte_carlo);
    EXPECT_NEAR(light.light.visibility(), sight.truth(surface), 0.004);
    EXPECT_LE(light.light.error, 0.002);
    EXPECT_EQ(by_rays(sight.setup, surface, 0.5, 0.001, 3).light.shadowed, light.light.shadowed);
    EXPECT_NE(by_rays(sight.setup, surface, 0.5, 0.001, 4).light.shadowed, light.light.shadowed);
    Sight counted({.method = Method::monte_carlo, .samples = 100});
    EXPECT_EQ(by_rays(counted.setup, counted.surface(9, 3), 0.5, 0.001, 3).light.rays, 100u);
}

}  // namespace
}  // namespace surimi
