// SPDX-License-Identifier: Apache-2.0
// Jacobi's axes, the cone of an ellipse or ellipsoid, and its irradiance, against quadrature over areas and outlines.
#include "runtime/ltc/ellipse.h"

#include <gtest/gtest.h>

#include "tests/support/quadrature.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

using test::Real;
using test::Vec3l;

struct Choice {
    Random random;
    double signed_unit() { return 2 * random.next() - 1; }
    Vec3 vector() {
        const double x = signed_unit(), y = signed_unit(), z = signed_unit();
        return {x, y, z};
    }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = vector();
            if (const double r = glm::length(v); r > 0.1 && r < 1) return v / r;
        }
    }
};

Ellipse<Real> in_long_double(const Ellipse<double>& e) {
    return {Vec3l(e.centre), Vec3l(e.half_u), Vec3l(e.half_v)};
}

Ellipsoid<Real> in_long_double(const Ellipsoid<double>& e) {
    return {Vec3l(e.centre), {Vec3l(e.half_axes[0]), Vec3l(e.half_axes[1]), Vec3l(e.half_axes[2])}};
}

/// A disk of radius r at height h over a point of the plane z = 0, which emits downwards.
Ellipse<double> ceiling(double x, double y, double h, double r) {
    return {{x, y, h}, {0, r, 0}, {r, 0, 0}};
}

double largest_entry(const Mat3& m) {
    double largest = 0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(m[i / 3][i % 3]));
    return largest;
}

TEST(SymmetricEigen, RebuildsTheMatrixAtAnyScale_M9) {
    Choice choice{{9}};
    for (int i = 0; i < 2000; ++i) {
        const Vec3 u = choice.vector(), v = choice.vector(), w = choice.vector();
        const double scale = std::pow(10.0, 200 * choice.signed_unit());
        const double sign = i % 3 - 1;  // definite, of rank 2, indefinite
        const Mat3 m = (glm::outerProduct(u, u) + glm::outerProduct(v, v) + sign * glm::outerProduct(w, w)) * scale;
        const auto eigen = eigen_of_symmetric(m);
        const Mat3 values(eigen.values[0] / scale, 0, 0, 0, eigen.values[1] / scale, 0, 0, 0, eigen.values[2] / scale);
        EXPECT_LT(largest_entry(eigen.axes * values * glm::transpose(eigen.axes) - m / scale), 1e-14) << i;
        EXPECT_LT(largest_entry(glm::transpose(eigen.axes) * eigen.axes - Mat3(1)), 4e-15) << i;
        EXPECT_NEAR(glm::determinant(eigen.axes), 1, 4e-15) << i;
        EXPECT_TRUE(eigen.values[0] >= eigen.values[1] && eigen.values[1] >= eigen.values[2]) << i;
    }
}

TEST(SymmetricEigen, IsDefinedForZeroEqualAndExtremeInput_M9) {
    const auto zero = eigen_of_symmetric(Mat3(0));
    EXPECT_EQ(zero.values[0], 0);
    EXPECT_EQ(zero.axes, Mat3(1));
    for (const double s : {5e-324, 1e-300, 1.0, 1e300}) {
        const auto equal = eigen_of_symmetric(Mat3(s));
        for (const double value : equal.values) EXPECT_EQ(value, s);
        EXPECT_EQ(equal.axes, Mat3(1));
        const auto ones = eigen_of_symmetric(Mat3(s, s, s, s, s, s, s, s, s));  // rank 1: 3 s, 0, 0
        EXPECT_NEAR(ones.values[0] / s, 3, 1e-15);
        EXPECT_NEAR(ones.values[1] / s, 0, 1e-15);
        EXPECT_NEAR(std::abs(ones.axes[0].x), std::sqrt(1.0 / 3), 1e-15);
    }
    const auto nan = eigen_of_symmetric(Mat3(std::nan("")));
    EXPECT_EQ(nan.values[2], 0);
}

TEST(SymmetricEigen, KeepsTheDigitsOfGradedMatrices_M9) {
    // D H D with D = (1, s, s^2): the small eigenvalues are far below the rounding of the large one.
    for (const double s : {1e-3, 1e-6, 1e-9}) {
        const Mat3 m(1, 0.5 * s, 0.25 * s * s, 0.5 * s, s * s, 0.5 * s * s * s, 0.25 * s * s, 0.5 * s * s * s,
                     s * s * s * s);
        const auto eigen = eigen_of_symmetric(m);
        using Matrix = glm::mat<3, 3, Real>;
        const auto exact = eigen_of_symmetric<Real>(Matrix(m));
        for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(eigen.values[i] / static_cast<double>(exact.values[i]), 1, 1e-14);
        // Schur's complements: 1, 3/4 s^2, then det / the product, to the order of s^2.
        EXPECT_NEAR(eigen.values[1] / (0.75 * s * s), 1, 2 * s * s + 1e-15);
    }
}

TEST(EllipseIrradiance, MatchesTheFormFactorsOfParallelDisks_M10) {
    // Over the middle r^2 / (h^2 + r^2); at distance d from the axis (Howell's B-12)
    // (1 - (d^2 + h^2 - r^2) / sqrt((d^2 + h^2 + r^2)^2 - 4 r^2 d^2)) / 2.
    for (const double h : {1e-3, 0.1, 1.0, 3.0})
        for (const double d : {0.0, 0.3, 0.7, 1.5, 4.0}) {
            const double r = 0.9, sum = d * d + h * h + r * r;
            const double expected = (1 - (sum - 2 * r * r) / std::sqrt(sum * sum - 4 * r * r * d * d)) / 2;
            const double e = irradiance_of_ellipse(ceiling(d, 0, h, r), Vec3(0), {0, 0, 1});
            EXPECT_NEAR(e / pi, expected, 2e-15 + 1e-15 / h) << h << ' ' << d;
        }
}

TEST(EllipseIrradiance, SphereIsItsSineSquared_M10) {
    for (const double d : {1.0 + 1e-6, 1.5, 10.0, 1e4, 1e8}) {
        const Ellipsoid<double> sphere{{0, 0.6 * d, 0.8 * d}, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}};
        const Vec3 to_centre(0, 0.6, 0.8);
        EXPECT_NEAR(irradiance_of_ellipsoid(sphere, Vec3(0), to_centre) / (pi / (d * d)), 1, 1e-14) << d;
    }
}

TEST(EllipseIrradiance, MatchesQuadratureOverTheArea_M11) {
    Choice choice{{11}};
    int crossing = 0;
    double worst = 0;
    for (int i = 0; i < 60; ++i) {
        const Ellipse<double> e{1.5 * choice.vector(), choice.vector(), choice.vector()};
        const Vec3 n = choice.direction();
        const double height = glm::dot(n, e.centre);
        const double reach = std::hypot(glm::dot(n, e.half_u), glm::dot(n, e.half_v));
        if (height < -reach) continue;
        crossing += height < reach;
        const double expected = static_cast<double>(test::area_irradiance(in_long_double(e), Vec3l(n)));
        const double outline = static_cast<double>(test::outline_irradiance(in_long_double(e), Vec3l(n)));
        const double value = irradiance_of_ellipse(e, Vec3(0), n, true);
        EXPECT_NEAR(outline, expected, 1e-11) << i;  // the two oracles
        EXPECT_NEAR(value, expected, 1e-11) << i;
        worst = std::max(worst, std::abs(value - outline));
    }
    EXPECT_GT(crossing, 20);
    EXPECT_LT(worst, 1e-13);
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
}

TEST(EllipseIrradiance, EllipsoidMatchesQuadratureOverItsSurface_M11) {
    Choice choice{{12}};
    int crossing = 0, seen = 0;
    for (int i = 0; i < 40; ++i) {
        const Ellipsoid<double> e{3.0 * choice.vector(), {choice.vector(), choice.vector(), choice.vector()}};
        const Vec3 n = choice.direction();
        const double height = glm::dot(n, e.centre);
        const double reach =
            glm::length(Vec3(glm::dot(n, e.half_axes[0]), glm::dot(n, e.half_axes[1]), glm::dot(n, e.half_axes[2])));
        if (height < -reach || cone_around<double>(e.centre, e.half_axes).is_inside) continue;
        ++seen;
        crossing += height < reach;
        const double expected = static_cast<double>(test::area_irradiance(in_long_double(e), Vec3l(n)));
        EXPECT_NEAR(irradiance_of_ellipsoid(e, Vec3(0), n), expected, 1e-10 * expected + 1e-13) << i;
    }
    EXPECT_GT(crossing, 10);
    EXPECT_GT(seen, crossing);
}

TEST(EllipseIrradiance, HorizonThroughTheMiddleOfASphere_M11) {
    // Half of a sphere over the horizon: 2/3 a^3 when far (a: sine of its radius).
    for (const double a : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const Ellipsoid<double> sphere{{1, 0, 0}, {Vec3(a, 0, 0), Vec3(0, a, 0), Vec3(0, 0, a)}};
        const double e = irradiance_of_ellipsoid(sphere, Vec3(0), {0, 0, 1});
        // Exactly: asin(a) - a sqrt(1 - a^2), whose series is used where it cancels.
        const double exact = a * a * a * (2.0 / 3 + a * a * (1.0 / 5 + a * a * 3.0 / 28));
        EXPECT_NEAR(e / exact, 1, 0.11 * std::pow(a, 6) + 1e-15 / (a * a)) << a;
    }
}

TEST(EllipseIrradiance, DoesNotDependOnTheConjugatePair_M10) {
    Choice choice{{14}};
    for (int i = 0; i < 200; ++i) {
        const Ellipse<double> e{2.0 * choice.vector(), choice.vector(), choice.vector()};
        const Vec3 n = choice.direction();
        const double t = 6 * choice.signed_unit(), c = std::cos(t), s = std::sin(t);
        const Ellipse<double> turned{e.centre, c * e.half_u + s * e.half_v, c * e.half_v - s * e.half_u};
        EXPECT_NEAR(irradiance_of_ellipse(turned, Vec3(0), n), irradiance_of_ellipse(e, Vec3(0), n), 1e-13) << i;
    }
}

TEST(EllipseIrradiance, ScaleAndShiftDoNotMatter_M10) {
    Choice choice{{15}};
    for (int i = 0; i < 50; ++i) {
        const Ellipse<double> e{2.0 * choice.vector(), choice.vector(), choice.vector()};
        const Vec3 n = choice.direction();
        const double expected = irradiance_of_ellipse(e, Vec3(0), n, true);
        for (const double s : {1e-60, 1e-20, 1e20, 1e60}) {
            const Ellipse<double> scaled{e.centre * s, e.half_u * s, e.half_v * s};
            EXPECT_NEAR(irradiance_of_ellipse(scaled, Vec3(0), n, true), expected, 1e-12) << s;
        }
        const Vec3 far(1e5, -1e5, 1e5);  // an ulp of 1e5 is 1.5e-11
        EXPECT_NEAR(irradiance_of_ellipse({e.centre + far, e.half_u, e.half_v}, far, n, true), expected, 1e-8) << i;
    }
}

TEST(EllipseIrradiance, SidesAndDegenerateInputAreDefined_M10) {
    const Ellipse<double> up = ceiling(0.2, 0.1, 0.5, 1), down{up.centre, up.half_v, up.half_u};
    const Vec3 n(0, 0, 1);
    const double e = irradiance_of_ellipse(up, Vec3(0), n);
    EXPECT_GT(e, 1);
    EXPECT_EQ(irradiance_of_ellipse(down, Vec3(0), n), 0);
    EXPECT_NEAR(irradiance_of_ellipse(down, Vec3(0), n, true), e, 1e-15);
    EXPECT_EQ(irradiance_of_ellipse(up, Vec3(0), -n), 0);
    for (const Vec3& in_plane : {Vec3(0.2, 0.1, 0.5), Vec3(0.3, 0.4, 0.5), Vec3(1.2, 0.1, 0.5), Vec3(5, 5, 0.5)})
        EXPECT_EQ(irradiance_of_ellipse(up, in_plane, {0, 0.6, 0.8}, true), 0);
    const Ellipsoid<double> ball{{0, 0, 1}, {Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 2)}};
    EXPECT_EQ(irradiance_of_ellipsoid(ball, Vec3(0), n), pi);
    EXPECT_EQ(irradiance_of_ellipsoid(ball, Vec3(0, 0, 1), n), pi);  // its centre
    const Ellipsoid<double> flat{up.centre, {up.half_u, up.half_v, Vec3(0)}};
    EXPECT_NEAR(irradiance_of_ellipsoid(flat, Vec3(0), n), e, 1e-15);
    const Ellipsoid<double> needle{up.centre, {up.half_u, Vec3(0), Vec3(0)}};
    EXPECT_EQ(irradiance_of_ellipsoid(needle, Vec3(0), n), 0);
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), inf, -inf}) {
        EXPECT_EQ(irradiance_of_ellipse(ceiling(bad, 0, 1, 1), Vec3(0), n), 0);
        EXPECT_EQ(irradiance_of_ellipse(ceiling(0, 0, 1, bad), Vec3(0), n), 0);
        EXPECT_EQ(irradiance_of_ellipse(up, Vec3(0, bad, 0), n), 0);
        EXPECT_EQ(irradiance_of_ellipse(up, Vec3(0), {0, 0, bad}), 0);
        EXPECT_EQ(irradiance_of_ellipsoid(ball, Vec3(0), {0, bad, 1}), 0);
    }
}

TEST(EllipseIrradiance, FloatKeepsFiveDigits_M11) {
    Choice choice{{16}};
    for (int i = 0; i < 200; ++i) {
        const Ellipse<double> e{Vec3(0, 0, 2) + choice.vector(), choice.vector(), choice.vector()};
        const Vec3 n = choice.direction();
        const Ellipse<float> f{Vec3f(e.centre), Vec3f(e.half_u), Vec3f(e.half_v)};
        EXPECT_NEAR(irradiance_of_ellipse(f, Vec3f(0), Vec3f(n), true), irradiance_of_ellipse(e, Vec3(0), n, true),
                    2e-5);
    }
}

}  // namespace
}  // namespace surimi
