// SPDX-License-Identifier: Apache-2.0
// The judge judged: triangle subtraction against rays and against closed forms that know nothing of triangles.
#include <gtest/gtest.h>

#include "tests/support/closed_form.h"
#include "tests/support/occlusion_scenes.h"
#include "tests/support/point_rays.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"
#include "tests/support/triangle_subtraction.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

/// Random surface points, the shading normal tilted: within 5 of the standard errors that independent rays would have
/// (Sobol points do better), and within 1 on average.
void expect_agreement_with_rays(const Scene& scene, int points, uint64_t seed) {
    const RayScene rays(scene);
    Choice choice{Random{seed}};
    int penumbra = 0;
    double normalised = 0;
    for (size_t monitor = 0; monitor < scene.monitors.size(); ++monitor) {
        const test::Obstructed obstructed = test::obstructed(scene, rays, monitor);
        for (int i = 0; i < points; ++i) {
            const SurfacePoint point = test::random_point(scene, choice, i % 2);
            const test::SubtractedIrradiance truth = test::subtract_triangles(obstructed, rays, point);
            EXPECT_LE(truth.shadowed, truth.unshadowed * (1 + 1e-12));
            if (truth.unshadowed < 1e-5) continue;
            const test::PointRays estimate = test::visibility_by_rays(scene, rays, obstructed, monitor, point, 4096);
            const double sigma = std::max(estimate.error, 1e-3), error = truth.visibility() - estimate.visibility;
            EXPECT_LE(std::abs(error), 5 * sigma) << "monitor " << monitor << " point " << i;
            if (!(truth.visibility() > 0.01 && truth.visibility() < 0.99)) continue;
            ++penumbra;
            normalised += error * error / (sigma * sigma);
        }
    }
    ASSERT_GT(penumbra, points / 12);
    EXPECT_LT(std::sqrt(normalised / penumbra), 1);
}

TEST(TriangleSubtraction, AgreesWithRaysInTheStudysRoom) {
    expect_agreement_with_rays(test::room_with(test::Contents::low), test::cases(150), 1);
}

TEST(TriangleSubtraction, AgreesWithRaysWhereGeometryIsBroken) {
    expect_agreement_with_rays(test::nasty_room(), test::cases(150), 2);
}

TEST(TriangleSubtraction, AgreesWithRaysForTwoSidedPanels) {
    Scene scene;
    test::add_box(scene, "Room", Vec3(0), Vec3(6), true);
    test::add_monitor(scene, "Monitor_R", 0, {0.3, 0.2, 0.1}, {0.9, 0.1, 0}, {0, 0.5, 0.2});
    scene.monitors[0].panels.push_back({{{-1.5, 0, -1}, {-1.5, 0, 1}, {-1.5, 1, 0.5}}});
    scene.monitors[0].two_sided = true;
    test::add_box(scene, "Box", {0.5, -1.5, 1.2}, {1, 0.7, 0.4});
    test::add_box(scene, "Other", {-0.4, 1.3, -1.4}, {0.8, 0.6, 0.9});
    expect_agreement_with_rays(scene, test::cases(300), 3);
}

TEST(TriangleSubtraction, IsExactBehindAConvexBox) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0.25, 2.5, -0.125}, {0.75, 0, 0}, {0, 0, 0.5});
    test::add_box(scene, "Box", {0.125, 0.875, -0.25}, {0.875, 0.375, 0.75});
    const RayScene rays(scene);
    const test::Obstructed obstructed = test::obstructed(scene, rays, 0);
    test::Occluder box;  // its corners are exact in float
    for (int i = 0; i < 8; ++i)
        box.points.push_back(Vec3(0.125, 0.875, -0.25) +
                             0.5 * Vec3(0.875, 0.375, 0.75) * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    Choice choice{Random{4}};
    int penumbra = 0;
    for (int i = 0; i < 500; ++i) {
        SurfacePoint point = surface_point(scene, {floor, 0}, Vec3(1.0 / 3));
        point.position = {choice.between(-2, 2), 0, choice.between(-2, 2)};
        const double truth = test::subtract_triangles(obstructed, rays, point).visibility();
        const double expected =
            test::exact_visibility(scene.monitors[0].panels[0], rays.ray_origin(point), point.normal, {{box}});
        EXPECT_NEAR(truth, expected, 1e-11);
        penumbra += truth > 0.01 && truth < 0.99;
    }
    EXPECT_GT(penumbra, 100);
}

TEST(TriangleSubtraction, NothingWithinTheClearanceHides) {
    for (const double gap : {0.5, 1.5}) {  // of the clearance
        Scene scene;
        const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Monitor_R", 0, {0, 2, 0}, {1, 0, 0}, {0, 0, 1});
        const double clearance = 1e-4 * std::sqrt(8.0) + 64 * 0x1p-24 * 1;  // the room's centre is at a height of 1
        const double y = 2 - gap * clearance;
        test::add_quad(scene, "Sheet", {-3, y, -3}, {3, y, -3}, {3, y, 3}, {-3, y, 3});
        const RayScene rays(scene);
        const test::SubtractedIrradiance result = test::subtract_triangles(
            test::obstructed(scene, rays, 0), rays, surface_point(scene, {floor, 0}, Vec3(1.0 / 3)));
        EXPECT_GT(result.unshadowed, 0.1);
        EXPECT_EQ(result.shadowed, gap < 1 ? result.unshadowed : 0);
    }
}

TEST(TriangleSubtraction, BlocksLightThatComesFromBelowTheSurface) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    test::add_monitor(scene, "Monitor_R", 0, {-2, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5});  // half of it below the floor
    const RayScene rays(scene);
    SurfacePoint point = surface_point(scene, {floor, 0}, {0.25, 0.25, 0.5});
    point.normal = normalize_or({-1, 0.001, 0}, {0, 1, 0});
    const test::SubtractedIrradiance result = test::subtract_triangles(test::obstructed(scene, rays, 0), rays, point);
    EXPECT_GT(result.unshadowed, 0.01);
    EXPECT_NEAR(result.visibility(), 0.5, 1e-3);
}

}  // namespace
}  // namespace surimi
