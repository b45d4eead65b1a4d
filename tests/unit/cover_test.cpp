// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/cover.h"

#include <gtest/gtest.h>

#include "baker/gather/gather.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A panel of 1.6 x 0.9 m at z = 0 that shines towards +z, and a floor before it.
struct Stage {
    Scene scene;
    Stage() {
        test::add_quad(scene, "Floor", {-2, -1, 4}, {2, -1, 4}, {2, -1, 0.5}, {-2, -1, 0.5});
        test::add_monitor(scene, "TV", 0, {0, 0, 0}, {0.8, 0, 0}, {0, 0.45, 0});
    }
    void add_plate(double z, const Vec2& half) {
        test::add_quad(scene, "Plate", {-half.x, -half.y, z}, {half.x, -half.y, z}, {half.x, half.y, z},
                       {-half.x, half.y, z});
    }
    Cover cover() const {
        const RayScene rays(scene);
        return find_cover(rays, panels_of(scene.monitors[0], rays)[0], 0);
    }
    double visibility(bool clears_covers = true) const {
        const RayScene rays(scene);
        GatherSettings settings;
        settings.clears_covers = clears_covers;
        const SurfacePoint point = surface_point(scene, {0, 0}, {0.3, 0.3, 0.4});
        const IrradianceEstimate e = irradiance_at(scene, rays, find_silhouettes(scene, rays), 0, point, settings);
        return static_cast<double>(e.shadowed / e.unshadowed);
    }
};

TEST(Cover, PaneOfGlassBeforeTheScreenDoesNotBlockIt_M66) {
    Stage stage;
    EXPECT_EQ(stage.cover().height, 0);
    stage.add_plate(0.002, {0.81, 0.46});
    stage.add_plate(0.005, {0.81, 0.46});
    EXPECT_NEAR(stage.cover().height, 0.005, 1e-6) << "front and back of the pane";
    EXPECT_EQ(stage.visibility(), 1);
    EXPECT_EQ(stage.visibility(false), 0);
    const RayScene rays(stage.scene);
    const auto lines = describe_covers(stage.scene, rays);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("monitor TV is covered by Plate"), std::string::npos) << lines[0];
}

TEST(Cover, MonitorBehindTheFaceOfItsWallShines_M66) {
    Stage stage;
    stage.add_plate(0.001, {5, 5});
    EXPECT_NEAR(stage.cover().height, 0.001, 1e-6);
    EXPECT_EQ(stage.visibility(), 1);
}

TEST(Cover, WhatIsFartherOrTiltedOrSmallBlocks_M66) {
    Stage far;  // a fortieth of the shorter side
    far.add_plate(0.0225, {0.81, 0.46});
    EXPECT_EQ(far.cover().height, 0);
    EXPECT_LT(far.visibility(), 0.1);
    Stage tilted;
    test::add_quad(tilted.scene, "Tilted", {-0.9, -0.5, 0.002}, {0.9, -0.5, 0.002}, {0.9, 0.5, 0.03},
                   {-0.9, 0.5, 0.03});
    EXPECT_EQ(tilted.cover().height, 0);
    Stage small;
    small.add_plate(0.002, {0.4, 0.2});
    EXPECT_EQ(small.cover().height, 0);
    EXPECT_LT(small.visibility(), 0.9);
}

TEST(Cover, ScaleAndDistanceDoNotMatter_M66) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
        Stage stage;
        stage.add_plate(0.002, {0.81, 0.46});
        for (Surface& surface : stage.scene.surfaces)
            for (Vec3& p : surface.positions) p *= scale;
        for (Vec3& corner : stage.scene.monitors[0].panels[0].corners) corner *= scale;
        EXPECT_NEAR(stage.cover().height, 0.002 * scale, 1e-5 * scale);
        EXPECT_EQ(stage.visibility(), 1) << scale;
    }
}

}  // namespace
}  // namespace surimi
