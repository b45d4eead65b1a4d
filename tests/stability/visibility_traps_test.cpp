// SPDX-License-Identifier: Apache-2.0
// Traps that cost the study of visibility (research/sampling.md 2.5) gross errors, set again.
#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

using test::Deviations;
using test::Mesh;
using test::VisibilityJudge;

Scene floor_and_panel() {
    Scene scene;
    test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0.125, 2.5, -0.25}, {0.75, 0, 0}, {0, 0, 0.5});
    return scene;
}

/// Both ways from one point.
struct Both {
    Deviations split, scanline;
    double truth_sum = 0;
    void add(const VisibilityJudge& judge, const SurfacePoint& point) {
        const double truth = judge.truth(point).visibility();
        split.add(judge.split(point), truth, point);
        scanline.add(judge.scanline(point, 0.001), truth, point);
        truth_sum += truth;
    }
};

TEST(VisibilityTraps, FlatDiagonalsOfQuadsSeenEdgeOn) {
    // A quad whose corners are rounded to float is two planes. Where the eye is between them, the faces beside the
    // diagonal are seen from different sides: it must be an edge, or both must count as one plane.
    Both found;
    Choice choice{Random{41}};
    for (int i = 0; i < test::cases(480); ++i) {
        Scene scene = floor_and_panel();
        const Vec3 corner(choice.between(-0.5, 0.5), choice.between(0.5, 1), choice.between(-0.5, 0.5));
        const Vec3 u = choice.between(0.3, 0.8) * choice.direction();
        const Vec3 v = choice.between(0.3, 0.8) * normalize_or(Vec3(0.3 * choice.vector() + Vec3(0, 1, 0)), {0, 1, 0});
        Mesh fan;  // a regular grid of coplanar triangles, or two only
        const int cells = i % 3 + 1;
        for (int y = 0; y <= cells; ++y)
            for (int x = 0; x <= cells; ++x)
                fan.positions.push_back(corner + u * (1.0 * x / cells) + v * (1.0 * y / cells));
        for (uint32_t y = 0; y < static_cast<uint32_t>(cells); ++y)
            for (uint32_t x = 0; x < static_cast<uint32_t>(cells); ++x) {
                const uint32_t a = y * static_cast<uint32_t>(cells + 1) + x, d = a + static_cast<uint32_t>(cells) + 1;
                fan.triangles.push_back({a, a + 1, d + 1});
                fan.triangles.push_back({a, d + 1, d});
            }
        test::add_surface(scene, "Sheet", fan);
        test::add_box(scene, "Box", {0.5, 1.5, 0.25}, {0.25, 0.25, 0.25});
        const VisibilityJudge judge(std::move(scene));
        const Vec3 normal = normalize_or(glm::cross(u, v), {1, 0, 0});
        for (int k = 0; k < 20; ++k) {
            // In the sheet's plane, to within rounding, and low.
            Vec3 origin = corner + choice.between(-1, 1) * u - choice.between(0.2, 1) * v;
            origin += choice.between(-2e-7, 2e-7) * normal;
            found.add(judge, judge.point_below(0, origin));
        }
    }
    EXPECT_GT(found.split.penumbra, test::cases(800));
    EXPECT_LT(found.split.largest(), 1e-5);
    EXPECT_LT(found.scanline.largest(), 0.005);
    EXPECT_LT(found.scanline.quantile(0.999), 0.001);
}

TEST(VisibilityTraps, HairThinGapsDoNotDecideForTheWholePanel) {
    // Two sheets nearly meet. The least number of occluders is in a gap too thin for a ray of floats.
    Both found;
    Choice choice{Random{42}};
    for (int i = 0; i < test::cases(800); ++i) {
        Scene scene = floor_and_panel();
        const double gap = i % 4 == 0 ? 0 : std::pow(10, choice.between(-8, -3));
        const double lean = choice.between(-0.5, 0.5), step = i % 3 == 0 ? choice.between(-1e-6, 1e-6) : 0;
        const Vec3 a(-lean, 1.25, 4), b(lean, 1.25, -4), aside(gap, step, 0), wide(6, 0, 0);
        test::add_quad(scene, "Left", a - wide, a, b, b - wide);
        Mesh right;  // with a vertex on the border that the left one does not have
        const Vec3 middle = 0.37 * a + 0.63 * b;
        right.positions = {a + aside, a + aside + wide, b + aside + wide, b + aside, middle + aside};
        right.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}};
        test::add_surface(scene, "Right", right);
        test::add_box(scene, "Box", {0.4, 1.75, 0.1}, {0.5, 0.25, 0.5});
        const VisibilityJudge judge(std::move(scene));
        for (int k = 0; k < 10; ++k) {
            SurfacePoint point = surface_point(judge.scene(), {0, 0}, {1, 0, 0});
            point.position = {choice.between(-1.5, 1.5), 0, choice.between(-1.5, 1.5)};
            found.add(judge, point);
        }
    }
    EXPECT_LT(found.split.largest(), 1e-5);
    EXPECT_LT(found.scanline.largest(), 0.005);
    EXPECT_LT(found.truth_sum, 0.01 * static_cast<double>(found.split.errors.size()));  // it is all but dark
}

TEST(VisibilityTraps, LongEdgesAlongTheScanlinesKeepTheError) {
    // Blinds whose edges are parallel to the panel's sides, seen from all over the floor.
    Both found;
    Scene scene = floor_and_panel();
    for (int slat = 0; slat < 12; ++slat) {
        const double z = -1.1 + 0.2 * slat;
        test::add_quad(scene, "Slat", {-3, 1.5, z}, {3, 1.5, z}, {3, 1.5, z - 0.1}, {-3, 1.5, z - 0.1});
    }
    const VisibilityJudge judge(std::move(scene));
    Choice choice{Random{43}};
    for (int i = 0; i < test::cases(2400); ++i) {
        SurfacePoint point = surface_point(judge.scene(), {0, 0}, {1, 0, 0});
        point.position = {choice.between(-1.5, 1.5), 0, choice.between(-1.5, 1.5)};
        found.add(judge, point);
    }
    EXPECT_GT(found.split.penumbra, test::cases(1600));
    EXPECT_LT(found.split.largest(), 1e-9 + test::float_ratio);
    EXPECT_LT(found.scanline.largest(), 0.005);
    EXPECT_LT(found.scanline.rmse(), 0.00025);
}

}  // namespace
}  // namespace surimi
