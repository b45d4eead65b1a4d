// SPDX-License-Identifier: Apache-2.0
// GGX and one transformed cosine against closed forms and quadrature in other coordinates.
#include <gtest/gtest.h>

#include <array>

#include "runtime/ltc/ggx.h"
#include "runtime/ltc/lobe.h"
#include "runtime/ltc/polygon.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

Vec3 direction(double z, double azimuth) {
    const double radius = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/// Integral over the sphere's part z in [low, 1] by midpoints, n x 2n.
template <class F>
double over_sphere(double low, int n, const F& f) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) sum += f(direction(low + (1 - low) * (i + 0.5) / n, pi * (j + 0.5) / n));
    return sum * (1 - low) / n * pi / n;
}

TEST(Ggx, RoughestAtNormalIncidenceReflectsOneMinusLogTwo_M20) {
    EXPECT_NEAR(ggx_albedo(1, 1).full, 1 - std::log(2.0), 1e-9);
}

TEST(Ggx, IsReciprocal_M20) {
    Random random{20};
    for (int i = 0; i < 100; ++i) {
        const Vec3 a = direction(random.next(), 7 * random.next()), b = direction(random.next(), 7 * random.next());
        const double alpha = 0.01 + 0.99 * random.next();
        const double there = ggx_times_cosine(alpha, a, b) * a.z, back = ggx_times_cosine(alpha, b, a) * b.z;
        EXPECT_NEAR(there / back, 1, 1e-10);
    }
    EXPECT_EQ(ggx_times_cosine(0.5, {0, 0, 1}, {0, 0, -1}), 0);
    EXPECT_EQ(ggx_times_cosine(0.5, {1, 0, 0}, {0, 0, 1}), 0);
}

TEST(Ggx, SamplesFollowTheirDensity_M21) {
    // Moments of the samples, an n x n midpoint rule, against integrals of the density over the sphere. The samples
    // jump where they leave the sphere's cap nowhere, so the rule's error is O(1/n).
    for (const double alpha : {0.3, 1.0})
        for (const double cosine : {0.15, 0.8}) {
            const Vec3 view = direction(cosine, 0.6);
            constexpr int n = 300;
            Vec3 mean(0);
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) mean += sample_ggx(alpha, view, (i + 0.5) / n, (j + 0.5) / n);
            mean /= n * n;
            const auto density = [&](const Vec3& w) { return ggx_density(alpha, view, w); };
            EXPECT_NEAR(over_sphere(-1, 500, density), 1, 2e-3) << alpha << ' ' << cosine;
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(over_sphere(-1, 500, [&](const Vec3& w) { return density(w) * w[k]; }), mean[k], 3e-3)
                    << alpha << ' ' << cosine;
        }
}

TEST(Ggx, SamplesEstimateTheAlbedo_M21) {
    const Vec3 view = direction(0.3, 2);
    double sum = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 light = sample_ggx(0.4, view, (i + 0.5) / n, (j + 0.5) / n);
            const double ratio = light.z > 0 ? ggx_times_cosine(0.4, view, light) / ggx_density(0.4, view, light) : 0;
            ASSERT_LE(ratio, 1 + 1e-9);
            sum += ratio / (n * n);
        }
    EXPECT_NEAR(sum, ggx_albedo(0.4, 0.3).full, 1e-5);
}

TEST(Ggx, QuadratureAgreesWithMidpointsOverTheHemisphere_M22) {
    for (const double alpha : {0.15, 0.4, 1.0})
        for (const double cosine : {0.1, 0.5, 1.0}) {
            const Vec3 view = direction(cosine, 0);
            const auto f = [&](const Vec3& w) { return ggx_times_cosine(alpha, view, w); };
            const auto schlick = [&](const Vec3& w) {
                return f(w) * std::pow(1 - glm::dot(view, normalize_or(view + w, {0, 0, 1})), 5);
            };
            const GgxAlbedo albedo = ggx_albedo(alpha, cosine);
            EXPECT_NEAR(over_sphere(0, 600, f), albedo.full, 2e-4) << alpha << ' ' << cosine;
            EXPECT_NEAR(over_sphere(0, 600, schlick), albedo.fresnel, 2e-4) << alpha << ' ' << cosine;
        }
}

TEST(Ggx, QuadratureHasConverged_M22) {
    for (const double alpha : {1e-5, 1e-3, 0.01, 0.3, 1.0})
        for (const double cosine : {1e-4, 0.03, 0.7, 1.0}) {
            double sum = 0;
            for (const GgxNode& node : ggx_nodes(alpha, cosine, 300, 300)) {
                ASSERT_TRUE(std::isfinite(node.value) && std::isfinite(node.weight));
                sum += node.value * node.weight;
            }
            EXPECT_NEAR(ggx_albedo(alpha, cosine).full, sum, 1e-7) << alpha << ' ' << cosine;
            EXPECT_LE(sum, 1);
        }
}

constexpr std::array<LobeShape, 3> shapes = {LobeShape{1, 0, 0, 0.6}, LobeShape{1.07, -0.25, 0.42, 0.94},
                                             LobeShape{0.9, -0.9, 0.8, 0.3}};

TEST(Lobe, DensityIntegratesToOne_M23) {
    for (const LobeShape& shape : shapes) {
        const Mat3 inverse = inverse_matrix(shape, 0.4, 0.5);
        // The density has a kink at the cosine's horizon: O(1/n^2).
        EXPECT_NEAR(over_sphere(-1, 800, [&](const Vec3& w) { return lobe_density(inverse, w); }), 1, 1e-4);
    }
}

TEST(Lobe, IntegralOverAPolygonIsTheTransformedPolygon_M23) {
    const Mat3 inverse = inverse_matrix(shapes[1], 0.4, 0.5);
    const Vec3 corner(-1.5, -0.4, 0.3), u(0.2, 1.1, 0.1), v(0.8, -0.1, 0.9);
    constexpr int n = 500;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 p = corner + u * ((i + 0.5) / n) + v * ((j + 0.5) / n);
            const double r = glm::length(p);
            sum += lobe_density(inverse, p / r) * std::abs(glm::dot(glm::cross(u, v), p)) / (r * r * r * n * n);
        }
    const std::array<Vec3, 4> corners = {inverse * corner, inverse * (corner + u), inverse * (corner + u + v),
                                         inverse * (corner + v)};
    EXPECT_NEAR(irradiance_of_polygon<double>(corners, Vec3(0), {0, 0, 1}, true) / pi, sum, 1e-5);
}

TEST(Lobe, SmoothLobePeaksInTheMirrorDirectionAtEveryAngle_M24) {
    for (const double cosine : {1.0, 0.7, 0.123, 0.01}) {
        const Mat3 inverse = inverse_matrix({}, 1e-3, cosine);
        const Vec3 peak = inverse * direction(cosine, pi);
        // Rounding of the mirror direction, in widths of the lobe.
        EXPECT_NEAR(std::hypot(peak.x, peak.y) / peak.z, 0, 1e-15 / (2e-3 * cosine)) << cosine;
        EXPECT_EQ(inverse[1].y, 1);
    }
    const Mat3 upright = inverse_matrix({}, 0.01, 1);
    EXPECT_DOUBLE_EQ(upright[2].z, 0.02);
    EXPECT_DOUBLE_EQ(upright[0].x, 1);
}

TEST(Lobe, SmoothLobeIsGgx_M24) {
    // Relative to the peak the difference is O(alpha) for fixed angles.
    for (const double cosine : {1.0, 0.6, 0.3}) {
        const double alpha = 1e-4;
        const Mat3 inverse = inverse_matrix({}, alpha, cosine);
        const Vec3 view = direction(cosine, 0), mirror = direction(cosine, pi);
        const double peak = lobe_density(inverse, mirror);
        EXPECT_NEAR(ggx_times_cosine(alpha, view, mirror) / peak, 1, 1e-6);
        const double tangent = std::sqrt(1 - cosine * cosine);
        for (const Vec3& step : {Vec3(cosine, 0, tangent), Vec3(0, 1, 0)}) {
            const Vec3 light = normalize_or(mirror + 2 * alpha * step, {0, 0, 1});
            EXPECT_NEAR(ggx_times_cosine(alpha, view, light) / peak, lobe_density(inverse, light) / peak, 30 * alpha);
        }
    }
}

TEST(Lobe, LeakIsTheIntegralBelowTheHorizon_M25) {
    for (const LobeShape& shape : shapes)
        for (const double cosine : {1.0, 0.5, 0.1}) {
            const Mat3 inverse = inverse_matrix(shape, 0.4, cosine);
            const double above = over_sphere(0, 600, [&](const Vec3& w) { return lobe_density(inverse, w); });
            EXPECT_NEAR(lobe_below_horizon(inverse), 1 - above, 1e-3);
        }
    EXPECT_EQ(lobe_below_horizon(Mat3(0)), 0);
    EXPECT_NEAR(lobe_below_horizon({Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)}), 1, 1e-15);
}

}  // namespace
}  // namespace surimi
