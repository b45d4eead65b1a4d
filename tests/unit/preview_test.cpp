// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "runtime/preview/render.h"
#include "runtime/preview/shade.h"
#include "tests/support/closed_form.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A white floor under a coloured monitor, and a map that halves the light on its right half.
struct Stage {
    Scene scene;
    VisibilityMap map;
    Stage() {
        const uint32_t floor = test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
        scene.surfaces[floor].uv_sets.assign(2, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        test::add_monitor(scene, "Monitor_G", 1, {0, 2, 0}, {0.5, 0, 0}, {0, 0, 0.5});
        scene.monitors[0].radiance = {3, 2, 1};
        map.visibility = Image<Vec3f>(64, 64, Vec3f(1));
        for (int y = 0; y < 64; ++y)
            for (int x = 32; x < 64; ++x) map.visibility.at(x, y) = Vec3f(1, 0.5f, 1);
    }
};

TEST(Preview, ShowsAlbedoTimesShadowedIrradiance) {
    const Stage stage;
    const RayScene rays(stage.scene);
    for (const double x : {-0.5, 0.5}) {
        const Seen seen = see(stage.scene, stage.map, rays, {x, 1, 0}, {0, -1, 0}, Show::lit);
        const double e = test::irradiance_by_quadrature(stage.scene.monitors[0].panels[0], {x, 0, 0}, {0, 1, 0}, 200);
        const Vec3 expected = Vec3(3, 2, 1) * e / pi * (x < 0 ? 1.0 : 0.5);
        EXPECT_NEAR(glm::length(seen.color - expected), 0, 1e-4 * glm::length(expected));
        EXPECT_NEAR(seen.distance, 1, 1e-5);
        EXPECT_TRUE(seen.is_surface);
    }
}

TEST(Preview, EachChannelShowsItsOwnMonitor) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Seen v = see(stage.scene, stage.map, rays, {0.5, 1, 0}, {0, -1, 0}, Show::visibility);
    EXPECT_NEAR(glm::length(v.color - Vec3(1, 0.5, 1)), 0, 1e-6);
    const Seen e = see(stage.scene, stage.map, rays, {0.5, 1, 0}, {0, -1, 0}, Show::unshadowed);
    const Seen s = see(stage.scene, stage.map, rays, {0.5, 1, 0}, {0, -1, 0}, Show::shadowed);
    EXPECT_EQ(e.color.r, 0);
    EXPECT_GT(e.color.g, 0.01);
    EXPECT_NEAR(s.color.g, 0.5 * e.color.g, 1e-9);
}

TEST(Preview, DoesNotSeeBackFacesOfSingleSidedMaterials) {
    Stage stage;
    const RayScene rays(stage.scene);
    const Seen below = see(stage.scene, stage.map, rays, {0.2, -1, 0.3}, {0, 1, 0}, Show::normals);
    EXPECT_GT(below.distance, 2.5);  // through the floor, to the monitor's front
    stage.scene.materials.emplace_back().double_sided = true;
    stage.scene.surfaces[0].material = 0;
    EXPECT_NEAR(see(stage.scene, stage.map, rays, {0.2, -1, 0.3}, {0, 1, 0}, Show::normals).distance, 1, 1e-5);
}

TEST(Preview, PictureIsUprightAndNotMirrored) {
    Scene scene;
    test::add_quad(scene, "Upper right", {0.2, 0.2, -2}, {0.4, 0.2, -2}, {0.4, 0.4, -2}, {0.2, 0.4, -2});
    const Picture picture = render(scene, {}, RayScene(scene), look_at(Vec3(0), {0, 0, -1}, 1.0),
                                   {.width = 40, .height = 40, .samples_per_side = 2, .show = Show::normals}, {});
    double upper_right = 0, elsewhere = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) (x >= 20 && y < 20 ? upper_right : elsewhere) += picture.pixels.at(x, y).z;
    EXPECT_GT(upper_right, 1);
    EXPECT_EQ(elsewhere, 0);
}

TEST(Preview, FilmicCurveIsMonotoneAndBounded) {
    double before = 0;
    for (double x = 1e-6; x < 1e12; x *= 1.1) {
        EXPECT_GE(filmic(x), before);
        EXPECT_LE(filmic(x), 1);
        before = filmic(x);
    }
    EXPECT_EQ(filmic(NAN), 0);
    EXPECT_EQ(filmic(-1), 0);
    EXPECT_EQ(filmic(INFINITY), filmic(1e6));
}

TEST(Preview, AutomaticFramingSeesSomethingLit) {
    const Scene scene = test::kanikama_room();
    const RayScene rays(scene);
    const VisibilityMap map;
    const View view = frame_automatically(scene, map, rays, 16.0 / 9);
    const Picture picture = render(scene, map, rays, view, {.width = 64, .height = 36, .samples_per_side = 1}, {});
    int lit = 0;
    for (const Vec3f& p : picture.pixels.pixels) lit += luminance(Vec3(p)) > 0;
    EXPECT_GT(lit, 64 * 36 / 2);
    EXPECT_GT(picture.bright_level, 0);
}

}  // namespace
}  // namespace surimi
