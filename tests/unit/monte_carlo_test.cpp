// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/monte_carlo.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <string>

#include "tests/support/closed_form.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A floor of 4 m as one chart of 4 x 4 texels under a monitor on the ceiling.
struct Stage {
    Scene scene;
    uint32_t floor = 0;

    Stage() {
        floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
    }
};

/// A sheet with one edge over the floor.
Stage half_shadowed() {
    Stage stage;
    test::add_quad(stage.scene, "Sheet", {-3, 1, 3}, {0.1, 1, 3}, {0.1, 1, -3}, {-3, 1, -3});
    return stage;
}

Stage behind_slats() {
    Stage stage;
    for (int i = -20; i < 20; ++i)
        test::add_quad(stage.scene, "Slat", {0.1 * i, 1, 3}, {0.1 * i + 0.04, 1, 3.1}, {0.1 * i + 0.04, 1, -3},
                       {0.1 * i, 1, -3.1});
    return stage;
}

constexpr size_t fine = 64;  // texels a side, of 6 cm
constexpr std::array<size_t, 4> penumbra = {20 * fine + 32, 32 * fine + 30, 32 * fine + 34, 40 * fine + 33};

/// What rays need of a stage that is set up; texels of the floor alone.
struct Ready {
    explicit Ready(const Stage& stage, size_t size = 4)
        : scene(stage.scene),
          rays(scene),
          sampler(scene.monitors[0]),
          atlas(test::whole_map_atlas(scene, stage.floor, static_cast<int>(size))) {
        Scene floor_only = scene;
        for (uint32_t s = 0; s < floor_only.surfaces.size(); ++s)
            if (s != stage.floor) floor_only.surfaces[s].triangles.clear();
        texels = find_texels(floor_only, atlas);
    }
    MonteCarloEstimate estimate(size_t texel, uint64_t key, int samples, double error = 0.001) const {
        const TexelSurface surface(scene, atlas, texels, texels.texels[texel]);
        return monte_carlo({.rays = rays,
                            .sampler = sampler,
                            .points = points,
                            .clearance = 1e-4,
                            .error = error,
                            .samples = samples,
                            .key = key},
                           surface);
    }

    const Scene& scene;
    RayScene rays;
    MonitorSampler sampler;
    Atlas atlas;
    Texels texels;
    SamplePoints points;
};

/// E-weighted average over 6 x 6 midpoints of a texel of the fine map.
double exact_over_texel(const Stage& stage, size_t texel, const test::Occluder& occluder) {
    const Polygon& light = stage.scene.monitors[0].panels[0];
    double seen = 0, all = 0;
    for (size_t i = 0; i < 36; ++i) {
        const double u = static_cast<double>(texel % fine) + (static_cast<double>(i % 6) + 0.5) / 6;
        const double v = static_cast<double>(texel / fine) + (static_cast<double>(i / 6) + 0.5) / 6;
        const Vec3 p(-2 + 4 * u / fine, 0, 2 - 4 * v / fine);
        const double e = test::irradiance_by_quadrature(light, p, {0, 1, 0}, 16);
        seen += e * test::exact_visibility(light, p, {0, 1, 0}, std::span(&occluder, 1));
        all += e;
    }
    return seen / all;
}

TEST(MonteCarlo, NothingInTheWayIsExactlyOne) {
    const Stage stage;
    const Ready ready(stage);
    for (size_t texel = 0; texel < 16; ++texel) {
        const MonteCarloEstimate estimate = ready.estimate(texel, texel, 0);
        EXPECT_TRUE(estimate.is_lit);
        EXPECT_EQ(estimate.visibility, 1);
        EXPECT_GT(estimate.error, 0);  // what no ray has met may be there
        EXPECT_LE(estimate.error, 0.001);
        EXPECT_GE(estimate.rays, 512);
    }
}

TEST(MonteCarlo, AClosedBoxIsExactlyZero) {
    Stage stage;
    test::add_box(stage.scene, "Box", {0, 0.5, 0}, {5, 2, 5});
    const Ready ready(stage);
    for (size_t texel = 0; texel < 16; ++texel) {
        const MonteCarloEstimate estimate = ready.estimate(texel, texel, 0);
        EXPECT_TRUE(estimate.is_lit);
        EXPECT_EQ(estimate.visibility, 0);
        EXPECT_GT(estimate.error, 0);
        EXPECT_LE(estimate.error, 0.001);
    }
}

TEST(MonteCarlo, BehindTheMonitorIsUnlitAndCostsNoRay) {
    Stage stage;
    std::swap(stage.scene.monitors[0].panels[0].corners[1], stage.scene.monitors[0].panels[0].corners[3]);
    const Ready ready(stage);
    const MonteCarloEstimate estimate = ready.estimate(5, 1, 0);
    EXPECT_FALSE(estimate.is_lit);
    EXPECT_EQ(estimate.visibility, 0);
    EXPECT_EQ(estimate.error, 1);
    EXPECT_EQ(estimate.rays, 0);
}

TEST(MonteCarlo, LightBelowTheSurfaceItselfIsBlockedWithoutARay) {
    Stage stage;
    for (Vec3& normal : stage.scene.surfaces[stage.floor].normals) normal = {0, -1, 0};  // shaded as if from below
    Polygon& panel = stage.scene.monitors[0].panels[0];
    for (Vec3& corner : panel.corners) corner.y = -corner.y;
    std::swap(panel.corners[1], panel.corners[3]);  // facing up from below
    const Ready ready(stage);
    const MonteCarloEstimate estimate = ready.estimate(5, 1, 256);
    EXPECT_TRUE(estimate.is_lit);
    EXPECT_EQ(estimate.visibility, 0);
    EXPECT_EQ(estimate.rays, 0);
}

TEST(MonteCarlo, WhatLiesWithinTheClearanceIsNoOccluder) {
    for (const auto& [distance, visibility] : {std::pair{0.5e-4, 1.0}, std::pair{2e-4, 0.0}}) {
        Stage stage;
        const Vec3 normal = front_normal(stage.scene.monitors[0].panels[0]);
        const auto& c = stage.scene.monitors[0].panels[0].corners;
        const Vec3 off = distance * normal;
        test::add_quad(stage.scene, "Glass", c[0] + off, c[1] + off, c[2] + off, c[3] + off);
        const Ready ready(stage);  // with a clearance of 1e-4
        EXPECT_EQ(ready.estimate(5, 1, 256).visibility, visibility) << distance;
    }
}

TEST(MonteCarlo, HolesOfAMaskedSheetLetLightThrough) {
    Stage stage = half_shadowed();
    Scene& scene = stage.scene;
    const uint32_t sheet = static_cast<uint32_t>(scene.surfaces.size() - 1);
    scene.surfaces[sheet].material = static_cast<int>(scene.materials.size());
    scene.materials.emplace_back();
    scene.materials.back().alpha_mode = AlphaMode::mask;
    scene.materials.back().base_color.a = 0.2;
    scene.materials.back().alpha_cutoff = 0.1;
    EXPECT_LT(Ready(stage).estimate(6, 1, 256).visibility, 1);
    scene.materials.back().alpha_cutoff = 0.5;
    EXPECT_EQ(Ready(stage).estimate(6, 1, 256).visibility, 1);
}

TEST(MonteCarlo, TakesAsManySamplesAsAsked) {
    const Stage stage = half_shadowed();
    const Ready ready(stage);
    for (const int samples : {1, 2, 7, 96, 256, 1000, 65536}) {
        const MonteCarloEstimate estimate = ready.estimate(6, 11, samples);
        EXPECT_EQ(estimate.rays, static_cast<size_t>(samples));
        EXPECT_NEAR(estimate.visibility, 0.846, 3 * estimate.error);
    }
}

TEST(MonteCarlo, DependsOnTheKeyAlone) {
    const Stage stage = half_shadowed();
    const Ready one(stage), other(stage);
    const MonteCarloEstimate estimate = one.estimate(6, 5, 256);
    EXPECT_EQ(other.estimate(6, 5, 256).visibility, estimate.visibility);
    EXPECT_EQ(other.estimate(6, 5, 256).error, estimate.error);
    EXPECT_NE(other.estimate(6, 6, 256).visibility, estimate.visibility);
    // The rounds of an adaptive run are the beginning of a longer one.
    const MonteCarloEstimate adaptive = one.estimate(6, 5, 0, 0.004);
    EXPECT_EQ(one.estimate(6, 5, static_cast<int>(adaptive.rays)).visibility, adaptive.visibility);
}

TEST(MonteCarlo, ReachesTheExactPenumbra) {
    Stage stage = half_shadowed();
    const Ready ready(stage, fine);
    const test::Occluder occluder{{{-3, 1, 3}, {0.1, 1, 3}, {0.1, 1, -3}, {-3, 1, -3}}};
    for (const size_t texel : penumbra) {
        const double exact = exact_over_texel(stage, texel, occluder);
        EXPECT_GT(exact, 0.01);
        EXPECT_LT(exact, 0.99);
        double mean = 0;
        for (uint64_t key = 0; key < 8; ++key) mean += ready.estimate(texel, key, 1 << 14).visibility / 8;
        EXPECT_NEAR(mean, exact, 4e-4);  // 8 x 2^14 samples are good to 2e-4, the midpoints of the texel to 1e-4
    }
}

/// RMS error and RMS of the estimated errors over keys and texels, with as many samples.
struct Observed {
    double error = 0, estimate = 0, beyond = 0;  // beyond: share off by more than 3 estimates
};
Observed observe(const Ready& ready, int samples) {
    constexpr uint64_t keys = 200;
    Observed sum;
    for (const size_t texel : penumbra) {
        double truth = 0;
        for (uint64_t key = 0; key < 4; ++key) truth += ready.estimate(texel, 1000 + key, 1 << 16).visibility / 4;
        for (uint64_t key = 0; key < keys; ++key) {
            const MonteCarloEstimate estimate = ready.estimate(texel, key, samples);
            const double error = estimate.visibility - truth;
            sum.error += error * error;
            sum.estimate += estimate.error * estimate.error;
            if (std::abs(error) > 3 * estimate.error) sum.beyond += 1;
        }
    }
    const double count = static_cast<double>(keys * penumbra.size());
    return {std::sqrt(sum.error / count), std::sqrt(sum.estimate / count), sum.beyond / count};
}

TEST(MonteCarlo, ErrorFallsFasterThanOfIndependentSamples) {
    const Stage stage = half_shadowed();
    const Ready ready(stage, fine);
    const double at_64 = observe(ready, 64).error, at_1024 = observe(ready, 1024).error;
    EXPECT_LT(at_64, 0.5 * std::pow(64, -0.74));
    EXPECT_LT(at_1024, 0.5 * std::pow(1024, -0.74));
    EXPECT_LT(at_1024 / at_64, std::pow(16, -0.65));
}

TEST(MonteCarlo, ErrorEstimateIsHonest_M52) {
    // Never below the truth in the mean (800 samples of an RMS: 5 %), nor above 4 times (measured: 1.0 to 2,
    // the most at an edge along the monitor's side).
    for (const bool has_slats : {false, true}) {
        const Stage stage = has_slats ? behind_slats() : half_shadowed();
        const Ready ready(stage, fine);
        for (const int samples : {64, 256, 1024, 4096}) {
            SCOPED_TRACE(std::to_string(samples) + (has_slats ? " samples behind slats" : " samples at an edge"));
            const Observed observed = observe(ready, samples);
            EXPECT_GT(observed.estimate, 0.95 * observed.error);
            EXPECT_LT(observed.estimate, 4 * observed.error);
            EXPECT_LE(observed.beyond, 0.03);  // 2 % of Student's t with 7 degrees of freedom are above 3
        }
    }
}

TEST(MonteCarlo, StopsWhereTheErrorAskedForIsReached_M52) {
    const Stage stage = behind_slats();
    const Ready ready(stage, fine);
    constexpr double error = 0.004;
    size_t beyond = 0, count = 0;
    for (const size_t texel : penumbra) {
        double truth = 0;
        for (uint64_t key = 0; key < 4; ++key) truth += ready.estimate(texel, 1000 + key, 1 << 16).visibility / 4;
        for (uint64_t key = 0; key < 100; ++key, ++count) {
            const MonteCarloEstimate estimate = ready.estimate(texel, key, 0, error);
            EXPECT_LE(estimate.error, error);
            EXPECT_GT(estimate.error, 0);
            if (std::abs(estimate.visibility - truth) > 3 * error) ++beyond;
        }
    }
    EXPECT_LE(beyond, count / 100);
}

TEST(MonteCarlo, SeesWhatHidesHalfAPercentOfTheMonitor) {
    // The trap of a probe: its first rays all arrive, and yet something is there.
    Stage stage;
    test::add_quad(stage.scene, "Leaf", {0.1, 1, 0.05}, {0.2, 1, 0.05}, {0.2, 1, 0.02}, {0.1, 1, 0.02});
    const Ready ready(stage, fine);
    const size_t texel = fine / 2 * fine + fine / 2 + 1;
    const double truth = ready.estimate(texel, 1, 1 << 16).visibility;
    EXPECT_GT(truth, 0.985);
    EXPECT_LT(truth, 0.999);
    for (uint64_t key = 0; key < 200; ++key) EXPECT_NEAR(ready.estimate(texel, key, 0, 0.001).visibility, truth, 0.006);
}

}  // namespace
}  // namespace surimi
