// SPDX-License-Identifier: Apache-2.0
// The line integral against quadrature and closed forms.
#include "runtime/ltc/line.h"

#include <gtest/gtest.h>

#include "tests/support/quadrature.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

using test::Real;
using test::Vec3l;

Real by_quadrature(const Vec3& from, const Vec3& to, const Vec3& n) {
    const Vec3l a(from), along = Vec3l(to) - a;
    const Real length = glm::length(along), height = glm::dot(Vec3l(n), a), slope = glm::dot(Vec3l(n), along);
    Real s0 = 0, s1 = 1;
    if (height < 0) s0 = slope > 0 ? std::min(Real(1), -height / slope) : 1;
    if (height + slope < 0) s1 = slope < 0 ? std::max(Real(0), -height / slope) : 0;
    const Real d = glm::length(glm::cross(a, along)) / length;
    return test::integral(
        [&](Real s) {
            const Vec3l p = a + s * along;
            const Real square = glm::dot(p, p);
            return length * d * glm::dot(Vec3l(n), p) / (square * square);
        },
        s0, s1);
}

TEST(LineIrradiance, MatchesQuadrature_M12) {
    Random random{12};
    const auto some = [&] { return 2 * random.next() - 1; };
    int crossing = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3 a(some(), some(), some()), b(some(), some(), some());
        const Vec3 n = normalize_or({some(), some(), some()}, {0, 0, 1});
        const double expected = static_cast<double>(by_quadrature(a, b, n));
        EXPECT_NEAR(irradiance_of_line(a, b, Vec3(0), n), expected, 1e-12 * expected + 1e-15) << i;
        crossing += glm::dot(a, n) * glm::dot(b, n) < 0;
    }
    EXPECT_GT(crossing, 100);
}

TEST(LineIrradiance, InfiniteLineOverheadIsPiQuarters_M12) {
    // integral of h^2 / (h^2 + l^2)^2 dl = pi / (2 h): a tube of radius R gives pi R / h, as an infinite cylinder does.
    for (const double h : {0.01, 1.0, 30.0})
        EXPECT_NEAR(irradiance_of_line<double>({-1e9, 0, h}, {1e9, 0, h}, Vec3(0), {0, 0, 1}) * h, pi / 2, 1e-12) << h;
}

TEST(LineIrradiance, AddsUpAndScalesInversely_M12) {
    const Vec3 a(-1, 0.5, 0.7), b(2, 1, -0.3), n = normalize_or({0.1, 0.2, 0.9}, {0, 0, 1});
    const double whole = irradiance_of_line(a, b, Vec3(0), n);
    double sum = 0;
    for (int i = 0; i < 16; ++i)
        sum += irradiance_of_line(a + (b - a) * (i / 16.0), a + (b - a) * ((i + 1) / 16.0), Vec3(0), n);
    EXPECT_NEAR(sum, whole, 1e-14);
    EXPECT_NEAR(irradiance_of_line(b, a, Vec3(0), n), whole, 1e-15);
    for (const double s : {1e-60, 1e-20, 1e20, 1e60})
        EXPECT_NEAR(irradiance_of_line(a * s, b * s, Vec3(0), n) * s / whole, 1, 1e-14) << s;
}

TEST(LineIrradiance, DegenerateInputIsDefined_M12) {
    const Vec3 n(0, 0, 1);
    EXPECT_EQ(irradiance_of_line<double>({1, 0, 1}, {1, 0, 1}, Vec3(0), n), 0);    // no length
    EXPECT_EQ(irradiance_of_line<double>({1, 0, -1}, {2, 0, -1}, Vec3(0), n), 0);  // below
    EXPECT_EQ(irradiance_of_line<double>({0, 0, -1}, {0, 0, 1}, Vec3(0), n), 0);   // through the point
    EXPECT_EQ(irradiance_of_line<double>({0, 0, 0}, {0, 0, 1}, Vec3(0), n), 0);    // from the point
    EXPECT_EQ(irradiance_of_line<double>({1, 1, 0}, {2, 1, 0}, Vec3(0), n), 0);    // in the horizon's plane
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), inf, -inf}) {
        EXPECT_EQ(irradiance_of_line<double>({bad, 0, 1}, {1, 0, 1}, Vec3(0), n), 0);
        EXPECT_EQ(irradiance_of_line<double>({0, 0, 1}, {1, bad, 1}, Vec3(0), n), 0);
        EXPECT_EQ(irradiance_of_line<double>({0, 0, 1}, {1, 0, 1}, {bad, 0, 0}, n), 0);
        EXPECT_EQ(irradiance_of_line<double>({0, 0, 1}, {1, 0, 1}, Vec3(0), {0, 0, bad}), 0);
    }
}

}  // namespace
}  // namespace surimi
