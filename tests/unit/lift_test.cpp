// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/lift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "baker/gather/lift_pieces.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr double lean = 0.3;  // radians of the normals at both ends of a facet
const Vec3 left(-std::sin(lean), 0, std::cos(lean)), right(std::sin(lean), 0, std::cos(lean));

/// A facet of a cylinder about an axis along y: corners at x = 0, 1 and 0 that have these normals.
Surface facet(const std::array<Vec3, 3>& normals = {left, right, left}, double scale = 1, const Vec3& place = Vec3(0)) {
    Surface surface;
    for (const Vec3& corner : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)})
        surface.positions.push_back(place + scale * corner);
    surface.normals.assign(normals.begin(), normals.end());
    surface.triangles = {{0, 1, 2}};
    return surface;
}

TEST(Lift, IsTheArcOverAChord_M63) {
    const auto round = round_triangle(facet(), 0);
    ASSERT_TRUE(round);
    // By hand: t (1 - t) sin(lean) (left + right) / (1 + cos(2 lean)), straight up.
    for (const double t : {0.1, 0.25, 0.5, 0.8})
        for (const double share : {0.0, 0.3, 1.0}) {
            const Vec3 lift = round->lift({(1 - t) * share, t, (1 - t) * (1 - share)});
            EXPECT_NEAR(lift.x, 0, 1e-15);
            EXPECT_NEAR(lift.y, 0, 1e-15);
            EXPECT_NEAR(lift.z, t * (1 - t) * std::tan(lean), 1e-15);
        }
    // The circle through both ends with these normals has the radius 1 / (2 sin(lean)); its arc is this much higher.
    const double arc = (1 - std::cos(lean)) / (2 * std::sin(lean));
    EXPECT_NEAR(round->lift({0.5, 0.5, 0}).z, arc, 0.03 * arc);
    EXPECT_GT(round->lift({0.5, 0.5, 0}).z, arc);
}

TEST(Lift, LeavesCornersWhereTheyAreAndAlongTheirTangentPlanes_M63) {
    const auto round = round_triangle(facet(), 0);
    ASSERT_TRUE(round);
    for (int i = 0; i < 3; ++i) {
        Vec3 corner(0);
        corner[i] = 1;
        EXPECT_EQ(round->lift(corner), Vec3(0));
    }
    const double step = 1e-6;
    const Vec3 moved = Vec3(step, 0, 0) + round->lift({1 - step, step, 0});
    EXPECT_NEAR(glm::dot(moved, left), 0, step * step);
}

TEST(Lift, GoesWithScaleWhereverTheTriangleLies_M63) {
    const double expected = round_triangle(facet(), 0)->lift({0.4, 0.4, 0.2}).z;
    for (const double scale : {1e-3, 1.0, 1e4})
        for (const Vec3& place : {Vec3(0), Vec3(1e5, -1e5, 1e5)}) {
            const auto round = round_triangle(facet({left, right, left}, scale, place), 0);
            ASSERT_TRUE(round);
            // Coordinates of 1e5 m are rounded to 2^-36 m.
            EXPECT_NEAR(round->lift({0.4, 0.4, 0.2}).z, scale * expected, 1e-14 * scale + (place.x > 0 ? 0x1p-34 : 0));
        }
}

TEST(Lift, FlatAndHollowTrianglesStay_M63) {
    const Vec3 up(0, 0, 1);
    EXPECT_FALSE(round_triangle(facet({up, up, up}), 0));
    EXPECT_FALSE(round_triangle(facet({left, left, left}), 0));
    EXPECT_FALSE(round_triangle(facet({right, left, right}), 0));
    const Vec3 hardly = normalize_or({5e-4, 0, 1}, up);
    EXPECT_FALSE(round_triangle(facet({up, hardly, up}), 0));
    // Corners of a box that share averaged normals.
    const double third = 1 / std::sqrt(3.0);
    EXPECT_FALSE(round_triangle(
        facet({Vec3(-third, -third, third), Vec3(third, -third, third), Vec3(-third, third, third)}), 0));
}

TEST(Lift, BrokenNormalsGiveNothingOrSomethingFinite_M63) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    int finite = 0;
    for (const Vec3& odd :
         {Vec3(0), Vec3(0, 0, -1), -left, Vec3(nan, 0, 1), Vec3(0, 0, nan), Vec3(0, 0, inf), Vec3(1, 0, 0)})
        for (const auto& normals :
             {std::array{odd, right, left}, std::array{left, odd, odd}, std::array{odd, odd, odd}}) {
            const auto round = round_triangle(facet(normals), 0);
            if (!round) continue;
            ++finite;
            const Vec3 lift = round->lift({0.4, 0.4, 0.2});
            EXPECT_TRUE(is_finite(lift));
            EXPECT_GE(lift.z, 0);
        }
    EXPECT_GT(finite, 0);
    Surface nothing = facet();
    nothing.positions.assign(3, Vec3(1, 2, 3));
    EXPECT_FALSE(round_triangle(nothing, 0));
}

/// A quad of 1 m that is a facet, under 4 x 4 texels.
struct Stage {
    Scene scene;
    Atlas atlas;
    Texels texels;

    explicit Stage(bool is_smooth = true) {
        test::add_quad(scene, "Facet", {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
        if (is_smooth) scene.surfaces[0].normals = {left, right, right, left};
        atlas = test::whole_map_atlas(scene, 0, 4);
        texels = find_texels(scene, atlas);
    }
    TexelSurface surface(size_t texel) const { return {scene, atlas, texels, texels.texels[texel]}; }
    TexelSurface lifted(size_t texel) const {
        TexelSurface result = surface(texel);
        const RayScene rays(scene);
        std::vector<Panel> panels;
        for (const Monitor& monitor : scene.monitors) panels = panels_of(monitor, rays);
        lift_pieces(rays, panels, result);
        return result;
    }
};

TEST(LiftPieces, MovesMiddlesAndKeepsAreas_M63) {
    const Stage stage;
    for (size_t i = 0; i < stage.texels.texels.size(); ++i) {
        const TexelSurface flat = stage.surface(i), lifted = stage.lifted(i);
        EXPECT_EQ(flat.area(), lifted.area());
        ASSERT_EQ(flat.pieces().size(), lifted.pieces().size());
        for (size_t k = 0; k < flat.pieces().size(); ++k) {
            const TexelSurface::Piece& piece = lifted.pieces()[k];
            EXPECT_TRUE(piece.is_lifted);
            EXPECT_EQ(flat.share_of(flat.pieces()[k]), lifted.share_of(piece));
            const SurfacePoint below = TexelSurface::point_of(flat.pieces()[k], piece.middle());
            const SurfacePoint above = TexelSurface::point_of(piece, piece.middle());
            const double t = below.position.x;
            EXPECT_NEAR(above.position.z, t * (1 - t) * std::tan(lean), 1e-6);  // UVs are float
            EXPECT_EQ(above.normal, below.normal);
            EXPECT_EQ(above.geometric_normal, above.normal);
        }
        lifted.for_each_corner([](const SurfacePoint& corner) { EXPECT_GE(corner.position.z, -1e-12); });
        const SurfacePoint center = lifted.center();
        EXPECT_GT(center.position.z, 0);
        EXPECT_EQ(center.geometric_normal, center.normal);
    }
}

TEST(LiftPieces, FlatShadingStaysToTheBit_M63) {
    const Stage stage(false);
    for (size_t i = 0; i < stage.texels.texels.size(); ++i) {
        const TexelSurface flat = stage.surface(i), lifted = stage.lifted(i);
        for (size_t k = 0; k < flat.pieces().size(); ++k) {
            EXPECT_FALSE(lifted.pieces()[k].is_lifted);
            EXPECT_EQ(flat.pieces()[k].position.origin, lifted.pieces()[k].position.origin);
            EXPECT_EQ(lifted.pieces()[k].plane_normal(), Vec3(0, 0, 1));
        }
    }
}

TEST(LiftPieces, StayWhereSomethingIsInTheWay_M63) {
    Stage stage;
    // Over the half of x < 1/2, 1 mm above the facet.
    test::add_quad(stage.scene, "Plate", {-1, -1, 1e-3}, {0.499, -1, 1e-3}, {0.499, 2, 1e-3}, {-1, 2, 1e-3});
    int stayed = 0, moved = 0;
    for (size_t i = 0; i < stage.texels.texels.size(); ++i)
        for (const TexelSurface& lifted = stage.lifted(i); const TexelSurface::Piece& piece : lifted.pieces()) {
            const bool is_under = TexelSurface::point_of(piece, piece.middle()).position.x < 0.5;
            EXPECT_EQ(piece.is_lifted, !is_under) << i;
            ++(is_under ? stayed : moved);
        }
    EXPECT_GT(stayed, 5);
    EXPECT_GT(moved, 5);
}

TEST(LiftPieces, StayBesideAStepThatHidesTheLight_M63) {
    const auto moved = [](double light_at) {
        Stage stage;
        test::add_monitor(stage.scene, "Monitor_R", 0, {0.5, light_at, 0.3}, {light_at > 0 ? 0.2 : -0.2, 0, 0},
                          {0, 0, 0.2});
        // 1 cm high, at y = 1.
        test::add_quad(stage.scene, "Step", {-1, 1, 0}, {2, 1, 0}, {2, 1, 0.01}, {-1, 1, 0.01});
        int count = 0;
        for (size_t i = 0; i < stage.texels.texels.size(); ++i)
            for (const TexelSurface& lifted = stage.lifted(i); const TexelSurface::Piece& piece : lifted.pieces())
                count += piece.is_lifted;
        return count;
    };
    EXPECT_EQ(moved(-4), 20);  // the step is behind
    EXPECT_EQ(moved(4), 15);   // but for the row beside it: over the others' horizon all of the monitor is free
}

}  // namespace
}  // namespace surimi
