// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/contacts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/base/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr int size = 4;

/// A floor of 4 m under 4 x 4 texels, and walls that stand on it or come through it.
struct Stage {
    Scene scene;
    Atlas atlas;
    Texels texels;

    Stage() {
        test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        atlas = test::whole_map_atlas(scene, 0, size);
        texels = find_texels(scene, atlas);
    }
    void add_wall(const Vec3& from, const Vec3& to) {
        test::add_quad(scene, "Wall", from, to, to + Vec3(0, 1, 0), from + Vec3(0, 1, 0));
    }
    /// The texel of which `place` is a point.
    TexelSurface surface_at(const Vec3& place) const {
        for (const Texel& texel : texels.texels) {
            TexelSurface surface(scene, atlas, texels, texel);
            if (glm::length(surface.center().position - place) < 0.6) return surface;
        }
        throw std::logic_error("no texel there");
    }
    TexelSurface::CutResult cut(TexelSurface& surface) const {
        const RayScene rays(scene);
        std::vector<Vec3> places;
        surface.for_each_corner([&](const SurfacePoint& p) { places.push_back(rays.ray_origin(p) - rays.center()); });
        return cut_at_contacts(rays, triangles_around(rays, places), surface);
    }
};

/// No piece has corners on both sides of x = `line`, and shares and samples are as before.
void expect_cut_along_x(const TexelSurface& surface, double line, double share_left) {
    double left = 0;
    for (const TexelSurface::Piece& piece : surface.pieces()) {
        double low = INFINITY, high = -INFINITY;
        for (const Vec2& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)}) {
            const double x = TexelSurface::point_of(piece, uv).position.x;
            low = std::min(low, x), high = std::max(high, x);
        }
        EXPECT_TRUE(high <= line + 1e-9 || low >= line - 1e-9) << low << ' ' << high;
        if (high <= line + 1e-9) left += surface.share_of(piece);
    }
    EXPECT_NEAR(left, share_left, 1e-9);
    int below = 0;
    for (uint32_t i = 0; i < 4096; ++i) {
        const auto r = scrambled(sobol::point(i), scrambling(2));
        below += surface.sample(r[0], r[1]).position.x < line;
    }
    EXPECT_NEAR(below / 4096.0, share_left, 5e-3) << "evenly by area all the same";
}

TEST(Contacts, AWallThatStandsOnATexelCutsIt_M57) {
    Stage stage;
    stage.add_wall({-0.7, 0, 5}, {-0.7, 0, -5});
    TexelSurface surface = stage.surface_at({-0.5, 0, -0.5});
    const double area = surface.area();
    const auto result = stage.cut(surface);
    EXPECT_TRUE(result.is_cut && result.is_whole);
    expect_cut_along_x(surface, -0.7, 0.3);
    EXPECT_NEAR(surface.area(), area, 1e-12);
    const SurfacePoint corner = TexelSurface::point_of(surface.pieces().back(), {1, 1});
    EXPECT_NEAR(glm::length(surface_point(stage.scene, corner.triangle, corner.barycentric).position - corner.position),
                0, 1e-6)
        << "barycentric weights are cut like places";
    TexelSurface other = stage.surface_at({1.5, 0, -0.5});
    EXPECT_FALSE(stage.cut(other).is_cut);
    EXPECT_EQ(other.pieces().size(), 1u);
}

TEST(Contacts, AWallThatComesThroughCutsToo_AndOneThatFloatsDoesNot_M57) {
    Stage through;
    through.add_wall({-0.2, -0.5, 5}, {-0.2, -0.5, -5});
    TexelSurface cut = through.surface_at({-0.5, 0, -0.5});
    EXPECT_TRUE(through.cut(cut).is_cut);
    expect_cut_along_x(cut, -0.2, 0.8);
    Stage above, below;
    above.add_wall({-0.2, 0.01, 5}, {-0.2, 0.01, -5});
    TexelSurface whole = above.surface_at({-0.5, 0, -0.5});
    EXPECT_FALSE(above.cut(whole).is_cut);
    below.add_wall({-0.2, -1.01, 5}, {-0.2, -1.01, -5});
    TexelSurface over = below.surface_at({-0.5, 0, -0.5});
    EXPECT_FALSE(below.cut(over).is_cut);
}

TEST(Contacts, ABoxOnATexelCutsNothingFartherThanItself_M57) {
    Stage stage;
    const Vec3 a(-0.7, 0, -0.7), b(-0.3, 0, -0.7), c(-0.3, 0, -0.3), d(-0.7, 0, -0.3);
    stage.add_wall(a, b), stage.add_wall(b, c), stage.add_wall(c, d), stage.add_wall(d, a);
    TexelSurface surface = stage.surface_at({-0.5, 0, -0.5});
    const auto result = stage.cut(surface);
    EXPECT_TRUE(result.is_cut && result.is_whole);
    double inside = 0;
    for (const TexelSurface::Piece& piece : surface.pieces()) {
        const Vec2 middle = piece.is_square ? Vec2(0.5) : Vec2(2.0 / 3, 1.0 / 3);
        const Vec3 p = TexelSurface::point_of(piece, middle).position;
        if (std::abs(p.x + 0.5) < 0.2 && std::abs(p.z + 0.5) < 0.2) inside += surface.share_of(piece);
    }
    EXPECT_NEAR(inside, 0.16, 1e-9);
}

TEST(Contacts, AThicketIsLeftToRays_M57) {
    Stage stage;
    for (int i = 0; i < 30; ++i) stage.add_wall({-0.98 + 0.03 * i, 0, 0}, {-0.97 + 0.03 * i, 0, -1});
    TexelSurface surface = stage.surface_at({-0.5, 0, -0.5});
    const size_t before = surface.pieces().size();
    const auto result = stage.cut(surface);
    EXPECT_TRUE(result.is_cut);
    EXPECT_FALSE(result.is_whole);
    EXPECT_EQ(surface.pieces().size(), before) << "as it was";
}

}  // namespace
}  // namespace surimi
