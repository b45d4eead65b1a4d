// SPDX-License-Identifier: Apache-2.0
// The outline of a capped cylinder against quadrature over its surface.
#include "runtime/ltc/cylinder.h"

#include <gtest/gtest.h>

#include "runtime/ltc/line.h"
#include "tests/support/quadrature.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

using test::Vec3l;

TEST(CylinderIrradiance, MatchesQuadratureOverTheSurface_M13) {
    Random random{13};
    const auto some = [&] { return 2 * random.next() - 1; };
    int crossing = 0, caps = 0, outside = 0;
    double worst = 0;
    for (int i = 0; i < 90; ++i) {
        const Vec3 a(2 * some(), 2 * some(), 2 * some()), b(2 * some(), 2 * some(), 2 * some());
        const double radius = 0.05 + random.next();
        const Vec3 n = normalize_or({some(), some(), some()}, {0, 0, 1}), axis = glm::normalize(b - a);
        const bool sees_cap = glm::dot(a, axis) > 0 || glm::dot(b, axis) < 0;
        if (!sees_cap && glm::length(glm::cross(a, axis)) < radius) continue;
        ++outside;
        caps += sees_cap;
        const double expected = static_cast<double>(test::area_irradiance(Vec3l(a), Vec3l(b), radius, Vec3l(n)));
        const double value = irradiance_of_cylinder({a, b, radius}, Vec3(0), n);
        EXPECT_NEAR(value, expected, 1e-11) << i;
        EXPECT_NEAR(irradiance_of_cylinder({b, a, radius}, Vec3(0), n), value, 1e-13) << i;
        worst = std::max(worst, std::abs(value - expected));
        crossing += expected > 0 && std::abs(glm::dot(n, a)) < glm::length(b - a);
    }
    EXPECT_GT(outside, 30);
    EXPECT_GT(caps, 10);
    EXPECT_GT(outside - caps, 10);
    EXPECT_GT(crossing, 10);
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
}

TEST(CylinderIrradiance, ThinOneIsALineOfItsWidth_M13) {
    const Vec3 a(-1, 0.5, 1), b(2, 0.2, 0.6), n(0, 0, 1);
    for (const double r : {1e-3, 1e-5}) {
        const double line = 2 * r * irradiance_of_line(a, b, Vec3(0), n);
        EXPECT_NEAR(irradiance_of_cylinder({a, b, r}, Vec3(0), n) / line, 1, 2 * r) << r;
    }
}

TEST(CylinderIrradiance, StandingOnTheHorizon_M13) {
    // The lower cap in the receiver's plane, as a lamp on a floor: seen edge-on.
    for (const double x : {0.6, 1.0, 3.0}) {
        const Cylinder<double> lamp{{x, 0, 0}, {x, 0, 1.5}, 0.5};
        const Vec3 n = normalize_or({0.3, 0.1, 1}, {0, 0, 1});
        for (const Vec3& normal : {Vec3(0, 0, 1), n}) {
            const double expected =
                static_cast<double>(test::area_irradiance(Vec3l(lamp.from), Vec3l(lamp.to), 0.5L, Vec3l(normal)));
            EXPECT_NEAR(irradiance_of_cylinder(lamp, Vec3(0), normal), expected, 1e-12) << x;
        }
    }
}

TEST(CylinderIrradiance, ScaleDoesNotMatterAndOddInputIsDefined_M13) {
    const Cylinder<double> lamp{{1, 0.2, -0.4}, {0.7, -0.3, 1.5}, 0.3};
    const Vec3 n(0, 0, 1);
    const double expected = irradiance_of_cylinder(lamp, Vec3(0), n);
    for (const double s : {1e-60, 1e-20, 1e20, 1e60})
        EXPECT_NEAR(irradiance_of_cylinder({lamp.from * s, lamp.to * s, lamp.radius * s}, Vec3(0), n), expected, 1e-12);
    EXPECT_EQ(irradiance_of_cylinder({lamp.from, lamp.to, 0.0}, Vec3(0), n), 0);
    EXPECT_EQ(irradiance_of_cylinder({lamp.from, lamp.from, 1.0}, Vec3(0), n), 0);
    EXPECT_EQ(irradiance_of_cylinder(lamp, lamp.from, n), pi);
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), inf, -inf}) {
        EXPECT_EQ(irradiance_of_cylinder({{bad, 0, 1}, lamp.to, 0.3}, Vec3(0), n), 0);
        EXPECT_EQ(irradiance_of_cylinder({lamp.from, {0, bad, 1}, 0.3}, Vec3(0), n), 0);
        EXPECT_EQ(irradiance_of_cylinder({lamp.from, lamp.to, bad}, Vec3(0), n), 0);
        EXPECT_EQ(irradiance_of_cylinder(lamp, {bad, 0, 0}, n), 0);
        EXPECT_EQ(irradiance_of_cylinder(lamp, Vec3(0), {0, bad, 0}), 0);
    }
}

}  // namespace
}  // namespace surimi
