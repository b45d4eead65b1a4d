// SPDX-License-Identifier: Apache-2.0
// Lambert's formula against closed forms, quadrature and its own symmetries.
#include "runtime/ltc/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/closed_form.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

using test::corner_form_factor;

/// A rectangle at height `h` that emits downwards, as seen from the origin with normal +z.
std::vector<Vec3> ceiling(double x0, double x1, double y0, double y1, double h) {
    return {{x0, y0, h}, {x0, y1, h}, {x1, y1, h}, {x1, y0, h}};
}

double irradiance(const std::vector<Vec3>& corners, const Vec3& point = Vec3(0), const Vec3& normal = {0, 0, 1}) {
    return irradiance_of_polygon<double>(corners, point, normal);
}

TEST(PolygonIrradiance, MatchesTheFormFactorOfAParallelRectangle_M1) {
    for (const double h : {0.01, 0.3, 1.0, 7.0, 1000.0})
        EXPECT_NEAR(irradiance(ceiling(0, 2, 0, 3, h)) / (pi * corner_form_factor(2, 3, h)), 1, 1e-12) << h;
}

TEST(PolygonIrradiance, TinyLightKeepsItsDigits_M1) {
    // E -> area / h^2 as the light shrinks; the next term is 2 (half-size)^2 / 3 of it at most.
    for (const double half : {1e-2, 1e-4, 1e-6, 1e-8}) {
        const double expected = 4 * half * half;
        EXPECT_NEAR(irradiance(ceiling(-half, half, -half, half, 1)) / expected, 1, 2 * half * half + 1e-7) << half;
    }
}

TEST(PolygonIrradiance, TinyLightInFloatKeepsFourDigits_M1) {
    using V = glm::vec3;
    const float half = 1e-3f;
    const std::vector<V> light = {{-half, -half, 1}, {-half, half, 1}, {half, half, 1}, {half, -half, 1}};
    const float value = irradiance_of_polygon<float>(light, V(0), V(0, 0, 1));
    EXPECT_NEAR(static_cast<double>(value) / (4 * 1e-6), 1, 1e-3);  // acos would be 2 % off
}

TEST(PolygonIrradiance, ClipsAtTheHorizonExactly_M4) {
    Random random{4};
    int crossing = 0;
    for (int i = 0; i < 300; ++i) {
        const auto some = [&] { return 2 * random.next() - 1; };
        const Vec3 center(3 * some(), 3 * some(), 1 + random.next());
        const Vec3 u(some(), some(), some()), v = glm::cross(u, Vec3(some(), some(), some()));
        const Polygon light{{center - u - v, center + u - v, center + u + v, center - u + v}};
        const Vec3 normal = normalize_or({some(), some(), some()}, {0, 0, 1});
        int below = 0;
        for (const Vec3& c : light.corners) below += glm::dot(c, normal) < 0;
        if (below == 0 || below == 4) continue;
        ++crossing;
        constexpr int n = 1500;
        const double expected = test::irradiance_by_quadrature(light, Vec3(0), normal, n);
        // Midpoint cells cut by the horizon or the light's plane carry an error of the order of a row of cells.
        EXPECT_NEAR(irradiance(light.corners, Vec3(0), normal), expected, 5e-3 * expected + 2e-4) << i;
        if (crossing == 40) break;
    }
    EXPECT_EQ(crossing, 40);
}

TEST(PolygonIrradiance, HalfTheSkyIsHalfOfPi_M4) {
    // A huge wall beside the point fills a quarter sphere: E = pi / 2.
    const double r = 1e9;
    const std::vector<Vec3> wall = {{1, -r, -r}, {1, -r, r}, {1, r, r}, {1, r, -r}};
    EXPECT_NEAR(irradiance(wall, Vec3(0), {0, 0, 1}), pi / 2, 1e-8);
}

TEST(PolygonIrradiance, DoesNotChangeWhenEverythingIsScaledOrShifted_M1) {
    const auto light = ceiling(-1, 2, -0.5, 0.25, 0.7);
    const double expected = irradiance(light);
    for (const double scale : {1e-60, 1e-6, 1e6, 1e60}) {
        auto scaled = light;
        for (Vec3& c : scaled) c *= scale;
        EXPECT_NEAR(irradiance(scaled), expected, 1e-13) << scale;
    }
    auto shifted = light;
    for (Vec3& c : shifted) c += Vec3(1e6, -1e6, 1e6);
    EXPECT_NEAR(irradiance(shifted, {1e6, -1e6, 1e6}), expected, 1e-8);
}

TEST(PolygonIrradiance, BehindIsDarkUnlessTwoSided_M1) {
    auto light = ceiling(-1, 1, -1, 1, 1);
    std::reverse(light.begin(), light.end());
    EXPECT_EQ(irradiance(light), 0);
    EXPECT_NEAR(irradiance_of_polygon<double>(light, Vec3(0), {0, 0, 1}, true), irradiance(ceiling(-1, 1, -1, 1, 1)),
                1e-15);
    EXPECT_EQ(irradiance(ceiling(-1, 1, -1, 1, -1)), 0);  // below the horizon
}

TEST(PolygonIrradiance, StaysInRangeHoweverNear_M1) {
    for (const double h : {1e-1, 1e-3, 1e-6, 1e-9}) {
        EXPECT_NEAR(irradiance(ceiling(-1, 1, -1, 1, h)), pi, 4 * h + 1e-12);     // above the middle
        EXPECT_NEAR(irradiance(ceiling(0, 1, -1, 1, h)), pi / 2, 4 * h + 1e-12);  // above an edge
        EXPECT_LE(irradiance(ceiling(0, 1, 0, 1, h)), pi);
    }
}

TEST(PolygonIrradiance, DegenerateInputHasADefinedAnswer_M1) {
    EXPECT_EQ(irradiance({Vec3(1), Vec3(1), Vec3(1)}), 0);
    EXPECT_EQ(irradiance({{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}), 0);  // no area
    EXPECT_EQ(irradiance({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}}), 0);  // in the horizon's plane
    for (const Vec3& corner : ceiling(-1, 1, -1, 1, 1)) {         // the point on a corner
        const double e = irradiance(ceiling(-1, 1, -1, 1, 1), corner);
        EXPECT_TRUE(e >= 0 && e <= pi) << e;
    }
    for (const Vec3 in_plane : {Vec3(5, 0, 1), Vec3(-1, 0, 1), Vec3(0, 0, 1)}) {  // in the light's plane
        const double e = irradiance(ceiling(-1, 1, -1, 1, 1), in_plane);
        EXPECT_TRUE(e >= 0 && e <= pi) << e;
    }
    EXPECT_EQ(irradiance(ceiling(-1, 1, -1, 1, 1), {5, 0, 1}), 0);
}

TEST(PolygonIrradiance, AddsUpOverASubdivision_M1) {
    const Vec3 normal = normalize_or({0.3, -0.2, 0.5}, {0, 0, 1});
    const double whole = irradiance(ceiling(-1, 3, -2, 2, 1.5), Vec3(0), normal);
    double sum = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            sum +=
                irradiance(ceiling(-1 + 0.5 * x, -0.5 + 0.5 * x, -2 + 0.5 * y, -1.5 + 0.5 * y, 1.5), Vec3(0), normal);
    EXPECT_NEAR(sum, whole, 1e-13);
}

}  // namespace
}  // namespace surimi
