// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/point_light.h"

#include <gtest/gtest.h>

#include <array>

#include "runtime/ltc/polygon.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// What points see of monitor 0 of a scene, each as a block of its own.
struct Sight {
    Scene scene;
    RayScene rays{scene};
    Silhouettes silhouettes = find_silhouettes(scene, rays);

    PointLight light(const SurfacePoint& point, const GatherSettings& settings = {}) const {
        const MonitorSetup setup = set_up(scene, rays, silhouettes, 0, settings);
        const Vec3 origin = rays.ray_origin(point) - rays.center();
        BlockSight sight;
        look_from(sight, setup, std::span(&origin, 1), 0);
        PointWorkspace work;
        return light_at(setup, sight, point, {3}, work);
    }
};

SurfacePoint point_at(const Vec3& position, const Vec3& normal) {
    return {{0, 0}, Vec3(1.0 / 3), position, normal, normal};
}

Scene floor_under_monitor() {
    Scene scene;
    test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
    return scene;
}

TEST(PointLight, PanelsOfAMonitorAddUp) {
    // The monitor's two halves as panels of their own, one of them hidden.
    Scene whole = floor_under_monitor(), halves = floor_under_monitor();
    const auto c = whole.monitors[0].panels[0].corners;
    const Vec3 low = 0.5 * (c[0] + c[1]), high = 0.5 * (c[3] + c[2]);
    halves.monitors[0].panels = {{{c[0], low, high, c[3]}}, {{low, c[1], c[2], high}}};
    for (Scene* scene : {&whole, &halves})
        test::add_quad(*scene, "Sheet", {-1.5, 1.2, 1}, {0.07, 1.2, 1}, {0.12, 1.2, -1}, {-1.5, 1.2, -1});
    const Sight one{whole}, two{halves};
    Choice choice{Random{1}};
    int penumbra = 0;
    for (int i = 0; i < 100; ++i) {
        const SurfacePoint point = point_at({choice.between(-2, 2), 0, choice.between(-2, 2)}, {0, 1, 0});
        const GatherSettings exact{.is_exact = true};
        const PointLight a = one.light(point, exact), b = two.light(point, exact);
        EXPECT_NEAR(a.unshadowed, irradiance_of_polygon<double>(c, point.position, point.normal), 1e-14);
        EXPECT_NEAR(a.unshadowed, b.unshadowed, 1e-14);
        EXPECT_NEAR(a.shadowed, b.shadowed, 1e-7) << "panels are weighed at the surface, seen from where rays start";
        penumbra += a.visibility() > 0.01 && a.visibility() < 0.99;
    }
    EXPECT_GT(penumbra, 20);
}

TEST(PointLight, BothSidesOfATwoSidedMonitorLight) {
    Scene scene = floor_under_monitor();
    const Vec3 above(0.3, 4, 0.2), below(0.3, 0, 0.2);
    EXPECT_EQ(Sight{scene}.light(point_at(above, {0, -1, 0})).unshadowed, 0);
    scene.monitors[0].two_sided = true;
    test::add_quad(scene, "Sheet", {0.2, 3, -1}, {0.2, 3, 1}, {2, 3, 1}, {2, 3, -1});
    const Sight sight{scene};
    const PointLight back = sight.light(point_at(above, {0, -1, 0}));
    EXPECT_GT(back.unshadowed, 0);
    EXPECT_GT(back.visibility(), 0.05);
    EXPECT_LT(back.visibility(), 0.95) << "its shadows are seen from the back";
    EXPECT_EQ(sight.light(point_at(below, {0, 1, 0})).visibility(), 1);
}

TEST(PointLight, PointsBehindAMonitorOrInItsPlaneGetNothing) {
    Scene scene;
    test::add_quad(scene, "Wall", {-2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {-2, 2, 0});
    test::add_monitor(scene, "Monitor_R", 0, {0, 1, 0}, {0.8, 0, 0}, {0, 0.45, 0});  // in the wall's own plane
    const Sight sight{scene};
    for (const Vec3& position : {Vec3(1.5, 1, 0), Vec3(0.3, 1.1, 0), Vec3(1.5, 1, -1e-9), Vec3(1, 1, -2)})
        for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, 0, -1)})
            for (const bool is_exact : {false, true}) {
                const PointLight light = sight.light(point_at(position, normal), {.is_exact = is_exact});
                EXPECT_EQ(light.unshadowed, 0);
                EXPECT_EQ(light.shadowed, 0);
                EXPECT_EQ(light.error, 0);
                EXPECT_EQ(light.method, TexelMethod::none);
            }
}

TEST(PointLight, AGluedScreenIsNotHiddenByItsWall) {
    Scene scene;
    test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, 0.01}, {-2, 0, 0.01});
    test::add_quad(scene, "Wall", {-2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {-2, 2, 0});
    test::add_monitor(scene, "Monitor_R", 0, {0, 1, 0}, {0.8, 0, 0}, {0, 0.45, 0});
    const Sight sight{scene};
    for (const double z : {0.02, 0.5, 1.9})
        EXPECT_EQ(sight.light(point_at({0.4, 0, z}, {0, 1, 0})).visibility(), 1) << z;
}

TEST(PointLight, SettingsForceTheMethod) {
    Scene scene = floor_under_monitor();
    test::add_quad(scene, "Sheet", {-1.5, 1.2, 1}, {0.07, 1.2, 1}, {0.12, 1.2, -1}, {-1.5, 1.2, -1});
    const Sight sight{scene};
    const SurfacePoint penumbra = point_at({0.1, 0, 0.1}, {0, 1, 0}), open = point_at({1.9, 0, 0.1}, {0, 1, 0});
    EXPECT_EQ(sight.light(penumbra, {.method = Method::split}).method, TexelMethod::split);
    EXPECT_EQ(sight.light(penumbra, {.is_exact = true}).method, TexelMethod::split);
    EXPECT_EQ(sight.light(penumbra, {.method = Method::scanline}).method, TexelMethod::scanline);
    for (const Method method : {Method::automatic, Method::split, Method::scanline}) {
        const PointLight light = sight.light(open, {.method = method});
        EXPECT_EQ(light.method, TexelMethod::ray) << "no silhouette in the way";
        EXPECT_EQ(light.rays, 1u);
        EXPECT_EQ(light.segments, 0u);
        EXPECT_EQ(light.visibility(), 1);
    }
    const double exact = sight.light(penumbra, {.is_exact = true}).visibility();
    for (const double error : {0.02, 0.004, 0.001}) {
        const PointLight light = sight.light(penumbra, {.error = error, .method = Method::scanline});
        EXPECT_LE(light.error, error);
        EXPECT_NEAR(light.visibility(), exact, error);
        EXPECT_GT(light.rays, 0u);
    }
}

TEST(PointLight, OneFacetHidesThePanelWithoutALook_M51) {
    Scene scene = floor_under_monitor();
    test::add_quad(scene, "Ceiling", {-9, 1, 9}, {9, 1, 9}, {9, 1, -9}, {-9, 1, -9});
    const PointLight light = Sight{scene}.light(point_at({0, 0, 0}, {0, 1, 0}));
    EXPECT_GT(light.unshadowed, 0);
    EXPECT_EQ(light.shadowed, 0);
    EXPECT_EQ(light.method, TexelMethod::certificate);
    EXPECT_EQ(light.rays, 0u) << "the block's ray is the block's";
}

}  // namespace
}  // namespace surimi
