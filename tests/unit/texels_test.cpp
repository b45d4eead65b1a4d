// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/texel_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// One triangle a, b, c in the plane z = 0 whose lightmap texels are its x and y in a map of 8 x 8.
struct Flat {
    Scene scene;
    Atlas atlas;
    Flat() {
        atlas.width = atlas.height = 8;
        atlas.charts.resize(1);
        scene.surfaces.resize(1);
        atlas.surfaces.resize(1);
    }
    void add(const Vec2& a, const Vec2& b, const Vec2& c) {
        Surface& s = scene.surfaces[0];
        const auto first = static_cast<uint32_t>(s.positions.size());
        for (const Vec2& p : {a, b, c}) s.positions.emplace_back(p, 0.0), s.normals.emplace_back(0, 0, 1);
        s.triangles.push_back({first, first + 1, first + 2});
        atlas.surfaces[0].uv.push_back({Vec2f(a / 8.0), Vec2f(b / 8.0), Vec2f(c / 8.0)});
        atlas.surfaces[0].chart.push_back(0);
    }
    std::set<uint32_t> indices() const {
        std::set<uint32_t> result;
        for (const Texel& t : find_texels(scene, atlas).texels) result.insert(t.index);
        return result;
    }
};

TEST(FindTexels, ListsEveryTexelThatATriangleTouches) {
    Flat flat;
    flat.add({0.9, 0.9}, {2.1, 0.95}, {1.5, 1.05});  // its middle covers no texel centre
    EXPECT_EQ(flat.indices(), (std::set<uint32_t>{0, 1, 2, 9}));
}

TEST(FindTexels, DoesNotListTexelsThatAreOnlyBorderedOn) {
    Flat flat;
    flat.add({1, 1}, {3, 1}, {1, 3});
    EXPECT_EQ(flat.indices(), (std::set<uint32_t>{9, 10, 17}));
}

TEST(FindTexels, AgreesWithDenseSamplingOnRandomTriangles) {
    Random random{1};
    for (int i = 0; i < 200; ++i) {
        Flat flat;
        const auto p = [&] { return Vec2(8 * random.next(), 8 * random.next()); };
        const Vec2 a = p(), b = p(), c = p();
        flat.add(a, b, c);
        const std::set<uint32_t> listed = flat.indices();
        for (int s = 0; s < 2000; ++s) {  // a point on the triangle is always in a listed texel
            const double u = std::sqrt(random.next()), v = random.next();
            const Vec2 q = (1 - u) * a + u * (1 - v) * b + u * v * c;
            EXPECT_TRUE(listed.contains(static_cast<uint32_t>(q.y) * 8 + static_cast<uint32_t>(q.x)));
        }
    }
}

TEST(FindTexels, KeepsSeveralTrianglesOfATexel) {
    Flat flat;
    flat.add({0, 0}, {8, 0}, {8, 8});
    flat.add({0, 0}, {8, 8}, {0, 8});
    const Texels texels = find_texels(flat.scene, flat.atlas);
    EXPECT_EQ(texels.texels.size(), 64u);
    for (const Texel& t : texels.texels) EXPECT_EQ(t.count, t.index % 9 == 0 ? 2u : 1u) << t.index;
}

TEST(TexelSurface, SamplesLieOnTheSurfaceWithinTheTexel) {
    Random random{2};
    for (int i = 0; i < 100; ++i) {
        Flat flat;
        const auto p = [&] { return Vec2(8 * random.next(), 8 * random.next()); };
        flat.add(p(), p(), p());
        const Texels texels = find_texels(flat.scene, flat.atlas);
        for (const Texel& texel : texels.texels) {
            const TexelSurface surface(flat.scene, flat.atlas, texels, texel);
            for (int s = 0; s < 8; ++s) {
                const SurfacePoint at = surface.sample(random.next(), random.next());
                EXPECT_GE(std::min({at.barycentric.x, at.barycentric.y, at.barycentric.z}), 0);
                // uv is float: 8 texels times half an ulp, and slivers that only touch the texel stand beside it.
                const double slack = surface.area() > 1e-6 ? 1e-5 : 0.5;
                EXPECT_NEAR(at.position.x, texel.index % 8 + 0.5, 0.5 + slack);
                EXPECT_NEAR(at.position.y, texel.index / 8 + 0.5, 0.5 + slack);
            }
        }
    }
}

TEST(TexelSurface, SpreadsSamplesEvenlyByArea_M8) {
    Flat flat;
    flat.add({0, 0}, {8, 0}, {8, 8});
    flat.add({0, 0}, {8, 8}, {0, 8});
    // The second triangle is steep: twice the surface under the same texel.
    for (size_t v = 3; v < 6; ++v)
        flat.scene.surfaces[0].positions[v].z = std::sqrt(3.0) * flat.scene.surfaces[0].positions[v].x;
    const Texels texels = find_texels(flat.scene, flat.atlas);
    const TexelSurface surface(flat.scene, flat.atlas, texels, texels.texels[0]);
    EXPECT_NEAR(surface.area(), 0.5 + 0.5 * 2, 1e-6);
    int steep = 0;
    constexpr int n = 4096;
    double x = 0;
    for (uint32_t i = 0; i < n; ++i) {
        const auto r = scrambled(sobol::point(i), scrambling(5));
        const SurfacePoint at = surface.sample(r[0], r[1]);
        steep += at.triangle.triangle == 1;
        x += at.position.x;
    }
    EXPECT_NEAR(steep / static_cast<double>(n), 2.0 / 3, 2.0 / n);
    // Mean x: 2/3 over the flat half, 1/3 over the steep one.
    EXPECT_NEAR(x / n, (2.0 / 3) / 3 + (1.0 / 3) * 2 / 3, 1e-3);
}

TEST(TexelSurface, AZeroAreaTriangleStillHasAPoint) {
    Flat flat;
    flat.add({1, 1}, {3, 1}, {5, 1});  // on a texel border, without area
    const Texels texels = find_texels(flat.scene, flat.atlas);
    ASSERT_FALSE(texels.texels.empty());
    for (const Texel& texel : texels.texels) {
        const TexelSurface surface(flat.scene, flat.atlas, texels, texel);
        EXPECT_EQ(surface.area(), 0);
        EXPECT_TRUE(is_finite(surface.sample(0.3, 0.9).position));
    }
}

TEST(TexelSurface, SharesOfPiecesAreThoseOfTheirAreas_M8) {
    Flat flat;
    flat.add({1, 1}, {2, 1}, {1, 2});  // half of texel (1, 1), twice
    flat.add({2, 1}, {2, 2}, {1, 2});
    flat.add({4, 4}, {4.5, 4}, {4, 4.5});  // an eighth of texel (4, 4), alone
    flat.add({5, 0}, {8, 0}, {5, 3});      // all of texel (5, 0) and more
    const Texels texels = find_texels(flat.scene, flat.atlas);
    const auto surface_at = [&](uint32_t index) {
        for (const Texel& texel : texels.texels)
            if (texel.index == index) return TexelSurface(flat.scene, flat.atlas, texels, texel);
        throw std::out_of_range("no such texel");
    };
    for (const auto& [index, pieces, area] :
         {std::tuple<uint32_t, size_t, double>{9, 2, 1}, {36, 1, 0.125}, {5, 1, 1}}) {
        const TexelSurface surface = surface_at(index);
        ASSERT_EQ(surface.pieces().size(), pieces) << index;
        EXPECT_NEAR(surface.area(), area, 1e-12);
        double sum = 0;
        for (const TexelSurface::Piece& piece : surface.pieces()) {
            EXPECT_NEAR(surface.share_of(piece), 1.0 / static_cast<double>(pieces), 1e-12);
            sum += surface.share_of(piece);
        }
        EXPECT_NEAR(sum, 1, 1e-15);
    }
    EXPECT_TRUE(surface_at(5).pieces()[0].is_square);
    EXPECT_FALSE(surface_at(36).pieces()[0].is_square);
}

TEST(TexelSurface, CenterIsTheMiddleOfAreaInOnePlane) {
    Flat flat;
    flat.add({1, 1}, {2, 1}, {1, 1.5});
    flat.add({2, 1}, {2, 2}, {1, 1.5});
    const Texels texels = find_texels(flat.scene, flat.atlas);
    const TexelSurface surface(flat.scene, flat.atlas, texels, texels.texels[0]);
    Vec3 sum(0);
    constexpr int side = 400;
    for (int i = 0; i < side * side; ++i)
        sum += surface.sample((i % side + 0.5) / side, (i / side + 0.5) / side).position / double{side * side};
    EXPECT_LT(glm::length(surface.center().position - sum), 1e-3);
    EXPECT_EQ(surface.center().normal, Vec3(0, 0, 1));
}

TEST(TexelSurface, CenterOfABentTexelLiesOnItsSurface) {
    Flat flat;
    flat.add({1, 1}, {2, 1}, {1, 2});
    flat.add({2, 1}, {2, 2}, {1, 2});
    flat.scene.surfaces[0].positions[4].z = 1;  // the second triangle is folded up
    const Texels texels = find_texels(flat.scene, flat.atlas);
    const TexelSurface surface(flat.scene, flat.atlas, texels, texels.texels[0]);
    const SurfacePoint center = surface.center();
    const SurfacePoint there = surface_point(flat.scene, center.triangle, center.barycentric);
    EXPECT_LT(glm::length(center.position - there.position), 1e-12);
    EXPECT_EQ(center.geometric_normal, there.geometric_normal);
}

TEST(TexelSurface, CornersHoldAllOfIt) {
    Random random{4};
    for (int i = 0; i < 50; ++i) {
        Flat flat;
        const auto p = [&] { return Vec2(8 * random.next(), 8 * random.next()); };
        const Vec2 a = p(), b = p(), c = p();
        flat.add(a, b, c);
        const Texels texels = find_texels(flat.scene, flat.atlas);
        for (const Texel& texel : texels.texels) {
            const TexelSurface surface(flat.scene, flat.atlas, texels, texel);
            Vec3 low(INFINITY), high(-INFINITY);
            size_t count = 0;
            surface.for_each_corner([&](const SurfacePoint& corner) {
                low = glm::min(low, corner.position);
                high = glm::max(high, corner.position);
                ++count;
            });
            EXPECT_GE(count, 3 * surface.pieces().size());
            const Vec2 at(texel.index % 8, texel.index / 8);
            if (surface.area() > 0) {
                EXPECT_GE(low.x, at.x - 1e-5);
                EXPECT_GE(low.y, at.y - 1e-5);
                EXPECT_LE(high.x, at.x + 1 + 1e-5);
                EXPECT_LE(high.y, at.y + 1 + 1e-5);
            }
            for (int s = 0; s < 20; ++s) {
                const Vec3 q = surface.sample(random.next(), random.next()).position;
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(q, low - 1e-9)) &&
                            glm::all(glm::lessThanEqual(q, high + 1e-9)));
            }
        }
    }
}

}  // namespace
}  // namespace surimi
