// SPDX-License-Identifier: Apache-2.0
// Splitting against triangle subtraction, point by point.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "tests/support/occlusion_scenes.h"
#include "tests/support/point_rays.h"
#include "tests/support/scenes.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

using test::Deviations;
using test::VisibilityJudge;

constexpr double generic = 1e-9 + test::float_ratio;
constexpr double degenerate = 1e-6 + test::float_ratio;

/// Random points of all surfaces, half of them with tilted shading normals.
Deviations deviations(const VisibilityJudge& judge, int points, uint64_t seed, double tolerance) {
    Deviations result;
    Choice choice{Random{seed}};
    for (size_t monitor = 0; monitor < judge.scene().monitors.size(); ++monitor) {
        for (int i = 0; i < points; ++i) {
            const SurfacePoint point = test::random_point(judge.scene(), choice, i % 2);
            const test::SubtractedIrradiance truth = judge.truth(point, monitor);
            if (truth.unshadowed < 1e-6) continue;
            const double value = judge.split(point, monitor);
            result.add(value, truth.visibility(), point);
            EXPECT_NEAR(value, truth.visibility(), tolerance)
                << "monitor " << monitor << " point " << i << " of "
                << judge.scene().surfaces[point.triangle.surface].name << " at " << point.position.x << ' '
                << point.position.y << ' ' << point.position.z;
        }
    }
    return result;
}

TEST(VisibilitySplit, IsExactInTheStudysRoom_M53) {
    const VisibilityJudge judge(test::room_with(test::Contents::low));
    const Deviations found = deviations(judge, test::cases(1500), 1, generic);
    EXPECT_GT(found.penumbra, test::cases(500));
    EXPECT_LT(found.rmse(), 1e-7);
}

TEST(VisibilitySplit, IsExactAmongAHundredThousandTriangles_M53) {
    const VisibilityJudge judge(test::room_with(test::Contents::mid));
    const Deviations found = deviations(judge, test::cases(12), 2, generic);
    EXPECT_GT(found.penumbra, test::cases(5) - 1);
}

TEST(VisibilitySplit, IsExactWhereGeometryIsBroken_M53) {
    const VisibilityJudge judge(test::nasty_room());
    const Deviations found = deviations(judge, test::cases(3000), 3, degenerate);
    EXPECT_GT(found.penumbra, test::cases(1000));
}

TEST(VisibilitySplit, IsExactFromPointsInLineWithManyFaces_M53) {
    const VisibilityJudge judge(test::nasty_room());
    Deviations found;
    for (size_t monitor = 0; monitor < 3; ++monitor)
        for (int x = -19; x <= 19; x += test::is_slow_build ? 4 : 1)
            for (int z = -19; z <= 19; ++z) {  // the faces of stacked boxes and of the copies lie in these planes
                SurfacePoint point = surface_point(judge.scene(), {0, 0}, {1, 0, 0});
                point.normal = point.geometric_normal = {0, 1, 0};
                point.position = {0.25 * x, 0, 0.25 * z};
                if (judge.is_ambiguous(point)) continue;
                const double truth = judge.truth(point, monitor).visibility(), value = judge.split(point, monitor);
                found.add(value, truth, point);
                EXPECT_NEAR(value, truth, degenerate) << monitor << ' ' << x << ' ' << z;
            }
    EXPECT_GT(found.penumbra, test::cases(300));
}

TEST(VisibilitySplit, IsExactForPanelsOfManyCornersAndTwoSides_M53) {
    Scene scene;
    test::add_box(scene, "Room", Vec3(0), Vec3(6), true);
    test::add_monitor(scene, "Monitor_R", 0, {0.3, 0.2, 0.1}, {0.9, 0.1, 0}, {0, 0.5, 0.2});
    std::vector<Polygon>& panels = scene.monitors[0].panels;
    panels.push_back({{{-1.5, 0, -1}, {-1.5, 0, 1}, {-1.5, 1, 0.5}}});
    panels.push_back({{{1, 2, 1}, {1.5, 2, 0.5}, {2, 2, 0.5}, {2.5, 2, 1}, {2, 2, 2}, {1.25, 2, 1.75}}});
    test::add_box(scene, "Box", {0.5, -1.5, 1.2}, {1, 0.7, 0.4});
    test::add_box(scene, "Other", {-0.4, 1.3, -1.4}, {0.8, 0.6, 0.9});
    for (const bool is_two_sided : {false, true}) {
        scene.monitors[0].two_sided = is_two_sided;
        const Deviations found = deviations(VisibilityJudge(scene), test::cases(1500), 4, generic);
        EXPECT_GT(found.penumbra, test::cases(100));
    }
}

TEST(VisibilitySplit, StatesTheUnshadowedIrradianceOfTheClosedForm_M1) {
    const VisibilityJudge judge(test::room_with(test::Contents::low));
    Choice choice{Random{5}};
    for (int i = 0; i < 500; ++i) {
        const SurfacePoint point = test::random_point(judge.scene(), choice, 0);
        GatherSettings settings;
        settings.is_exact = true;
        const IrradianceEstimate estimate =
            irradiance_at(judge.scene(), judge.rays(), judge.silhouettes(), 0, point, settings);
        const double truth = judge.truth(point, 0).unshadowed;
        EXPECT_NEAR(static_cast<double>(estimate.unshadowed), truth, 1e-5 + 1e-4 * truth);  // above the offset
        EXPECT_LE(estimate.shadowed, estimate.unshadowed);
    }
}

TEST(VisibilitySplit, IsExactInRealScenesAndAgreesWithManyRays_M53) {
    const char* folder = std::getenv("SURIMI_SCENES");
    if (test::is_slow_build || !folder || !*folder) GTEST_SKIP() << "no sanitizers, and a folder SURIMI_SCENES, please";
    size_t judged = 0;
    for (const char* name : {"home-theater", "living-room", "veach-ajar"}) {
        const std::filesystem::path file = std::filesystem::path(folder) / name / (std::string(name) + ".glb");
        if (!std::filesystem::exists(file)) continue;
        SCOPED_TRACE(name);
        Scene loaded = read_gltf(file);
        find_monitors(loaded, {});
        for (Material& material : loaded.materials) material.alpha_mode = AlphaMode::opaque;  // polygons only
        const VisibilityJudge judge(std::move(loaded));
        Choice choice{Random{6}};
        Deviations against_rays;
        for (size_t monitor = 0; monitor < judge.scene().monitors.size(); ++monitor) {
            const test::Obstructed obstructed = test::obstructed(judge.scene(), judge.rays(), monitor);
            for (int i = 0; i < test::cases(30); ++i) {
                const SurfacePoint point = test::random_point(judge.scene(), choice, 0);
                const test::SubtractedIrradiance truth = judge.truth(point, monitor);
                if (truth.unshadowed < 1e-6 || judge.is_ambiguous(point)) continue;
                const double value = judge.split(point, monitor);
                EXPECT_NEAR(value, truth.visibility(), degenerate) << monitor << ' ' << i;
                ++judged;
                const test::PointRays rays =
                    test::visibility_by_rays(judge.scene(), judge.rays(), obstructed, monitor, point, 25600);
                if (rays.error < 0.005) against_rays.add(value, rays.visibility, point);  // enough of them are lit
            }
        }
        EXPECT_LE(against_rays.rmse(), 4e-4);
        EXPECT_LE(against_rays.largest(), 1.5e-3) << against_rays.worst;
    }
    if (judged == 0) GTEST_SKIP() << "none of the rooms is in SURIMI_SCENES";
}

}  // namespace
}  // namespace surimi
