// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/monte_carlo.h"

#include <gtest/gtest.h>

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

/// What rays need of a stage that is set up; texels of the floor alone.
struct Ready {
    explicit Ready(const Stage& stage, int size = 4)
        : scene(stage.scene),
          rays(scene),
          sampler(scene.monitors[0]),
          atlas(test::whole_map_atlas(scene, stage.floor, size)) {
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

TEST(MonteCarlo, TakesAsManySamplesAsAsked) {
    Stage stage;
    test::add_quad(stage.scene, "Sheet", {-3, 1, 3}, {0.1, 1, 3}, {0.1, 1, -3}, {-3, 1, -3});
    const Ready ready(stage);
    for (const int samples : {1, 2, 7, 96, 256, 1000, 65536}) {
        const MonteCarloEstimate estimate = ready.estimate(6, 11, samples);
        EXPECT_EQ(estimate.rays, static_cast<size_t>(samples));
        EXPECT_NEAR(estimate.visibility, 0.846, 3 * estimate.error);
    }
}

}  // namespace
}  // namespace surimi
