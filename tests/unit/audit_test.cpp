// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/audit.h"

#include <gtest/gtest.h>

#include <memory>

#include "baker/gather/monte_carlo.h"
#include "runtime/base/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr int size = 16;

/// A floor half under a sheet, and a bake of it that is right to 2e-4.
struct Bake {
    Scene scene;
    Atlas atlas;
    Texels texels;
    std::unique_ptr<RayScene> rays;
    std::vector<IrradianceEstimate> estimates;

    Bake() {
        const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
        test::add_quad(scene, "Sheet", {-1, 1, 1}, {0.1, 1, 1.3}, {0.4, 1, -1}, {-1, 1, -1});
        atlas = test::whole_map_atlas(scene, floor, size);
        Scene floor_only = scene;
        for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
            if (s != floor) floor_only.surfaces[s].triangles.clear();
        texels = find_texels(floor_only, atlas);
        rays = std::make_unique<RayScene>(scene);
        const MonitorSampler sampler(scene.monitors[0]);
        const SamplePoints points;
        for (const Texel& texel : texels.texels) {
            const TexelSurface surface(scene, atlas, texels, texel);
            const MonteCarloTask task{.rays = *rays,
                                      .sampler = sampler,
                                      .points = points,
                                      .clearance = 2e-4,
                                      .samples = 1 << 15,
                                      .key = hash(7, texel.index)};
            const MonteCarloEstimate estimate = monte_carlo(task, surface);
            estimates.push_back({1, static_cast<float>(estimate.visibility), static_cast<float>(estimate.error),
                                 TexelMethod::monte_carlo});
        }
    }
    Audit audited(size_t count, double error) const {
        return audit(scene, atlas, texels, *rays, 0, estimates, {.error = error}, count, {});
    }
};

TEST(Audit, PassesAMapThatIsRight) {
    const Bake bake;
    const Audit result = bake.audited(150, 0.004);
    EXPECT_EQ(result.texels, 150);
    EXPECT_LT(result.rmse, 5e-4);
    EXPECT_LE(result.rmse_low, result.rmse);
    EXPECT_GE(result.rmse_high, result.rmse);
    EXPECT_GT(result.reference_error, 0);
    EXPECT_LT(result.reference_error, 4e-4);
    EXPECT_EQ(result.beyond, 0);
    EXPECT_NEAR(result.beyond_high, 3.0 / 150, 5e-4);
}

TEST(Audit, FindsAWrongTexel) {
    Bake bake;
    IrradianceEstimate& wrong = bake.estimates[100];
    wrong.shadowed += wrong.shadowed > 0.5f ? -0.1f : 0.1f;
    const Audit result = bake.audited(size * size, 0.004);
    EXPECT_EQ(result.texels, bake.texels.texels.size());
    EXPECT_EQ(result.beyond, 1);
    EXPECT_NEAR(result.largest, 0.1, 0.005);
    EXPECT_NEAR(result.rmse, 0.1 / size, 0.0005);  // one of size^2 texels is off by 0.1
}

TEST(Audit, SaysHowFarOffAMapIs) {
    Bake bake;
    for (IrradianceEstimate& estimate : bake.estimates) estimate.shadowed += 0.003f;
    const Audit result = bake.audited(100, 0.004);
    EXPECT_NEAR(result.rmse, 0.003, 2e-4);
    EXPECT_LT(result.rmse_low, 0.003 + 1e-4);
    EXPECT_GT(result.rmse_high, 0.003 - 1e-4);
    EXPECT_EQ(result.beyond, 0);
    EXPECT_GE(bake.audited(100, 0.001).beyond, 90);  // some references are not sure enough to say
}

TEST(Audit, DrawsOnlyTexelsWithLight) {
    Bake bake;
    for (size_t i = 0; i < bake.estimates.size(); ++i)
        if (i % 8 != 0) bake.estimates[i] = {};
    EXPECT_EQ(bake.audited(1000, 0.004).texels, bake.estimates.size() / 8);
    for (IrradianceEstimate& estimate : bake.estimates) estimate = {};
    const Audit nothing = bake.audited(10, 0.004);
    EXPECT_EQ(nothing.texels, 0);
    EXPECT_EQ(nothing.beyond_high, 1);
}

}  // namespace
}  // namespace surimi
