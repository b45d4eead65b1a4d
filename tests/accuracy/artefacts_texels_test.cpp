// SPDX-License-Identifier: Apache-2.0
// Odd texels: slivers, two triangles in one, the one at the origin, black ones.
#include <gtest/gtest.h>

#include "baker/texel/texel_surface.h"
#include "tests/scenes/texels.h"
#include "tests/support/map_judge.h"

namespace surimi {
namespace {

using test::ArtefactScene;
using test::MapJudge;
using test::Misses;
using test::of_size;

BakeSettings own_charts() {
    BakeSettings settings = of_size(test::odd_texel_map);
    settings.unwrap.uv = UvSource::existing;
    return settings;
}

TEST(SliverCharts, AreExactlyLit_M3) {
    const ArtefactScene stage = test::sliver_charts();
    const Bake baked = bake(stage.scene, of_size(128), {});
    const MapJudge judge(stage, baked);
    for (const uint32_t surface : stage.surfaces) {
        const Misses misses = judge.compare_with(surface, 1, 0);
        EXPECT_GT(misses.checked, 40u);
        EXPECT_EQ(misses.wrong, 0u) << misses.text();
    }
}

TEST(TwoTrianglesInATexel, WithTwoShadowsAreWeighedByTheirLight_M3) {
    const ArtefactScene stage = test::texels_with_two_shadows();
    const BakeSettings settings = own_charts();
    const Bake baked = bake(stage.scene, settings, {});
    const Misses misses = MapJudge(stage, baked).compare_texels(settings.gather.error);
    EXPECT_GT(misses.checked, static_cast<size_t>(test::cases(100)));
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
    for (int y = 5; y < 11; ++y) {
        const float v = baked.pages[0].map.visibility.at(10, y).x;
        EXPECT_GT(v, 0.4f);
        EXPECT_LT(v, 0.6f);
    }
}

TEST(TwoTrianglesInATexel, WithTwoNormalsAreBothMeasured_M3) {
    const ArtefactScene stage = test::texels_with_two_normals();
    const BakeSettings settings = own_charts();
    const Bake baked = bake(stage.scene, settings, {});
    const Misses misses = MapJudge(stage, baked).compare_with(stage.surfaces[0], 1, 0);
    EXPECT_GT(misses.checked, 100u);
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
    // The shared texels' unshadowed light is that of both triangles: between those of the texels beside them.
    for (int y = 5; y < 11; ++y) {
        const auto light = [&](int x) { return baked.pages[0].irradiance[0].at(x, y).unshadowed; };
        EXPECT_NEAR(light(10), 0.5f * (light(9) + light(11)), 0.25f * std::abs(light(9) - light(11)));
    }
}

TEST(TexelAtTheOrigin, IsMeasuredLikeAnyOther_M3) {
    const ArtefactScene stage = test::texel_at_the_origin();
    const BakeSettings settings = own_charts();
    const Bake baked = bake(stage.scene, settings, {});
    const Texels texels = find_texels(stage.scene, baked.atlas);
    size_t found = 0;
    for (const Texel& texel : texels.texels) {
        const Vec3 middle = TexelSurface(stage.scene, baked.atlas, texels, texel).center().position;
        if (baked.atlas.charts[texel.chart].surface != 0 || glm::length(middle) > 1e-6) continue;
        EXPECT_EQ(baked.pages[0].state[0].pixels[texel.index], TexelState::covered);
        EXPECT_GT(baked.pages[0].map.visibility.pixels[texel.index].x, 0.1f);
        EXPECT_LT(baked.pages[0].map.visibility.pixels[texel.index].x, 0.9f);
        ++found;
    }
    EXPECT_EQ(found, 1u);
    const Misses misses = MapJudge(stage, baked).compare_texels(settings.gather.error);
    EXPECT_GT(misses.checked, static_cast<size_t>(test::cases(250)));
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
}

TEST(BlackTexels, AreMeasuredAndWhatIsUnlitTakesTheirBlack_M3) {
    const ArtefactScene stage = test::black_beside_unlit();
    const Bake baked = bake(stage.scene, of_size(64), {});
    const MapJudge judge(stage, baked);
    EXPECT_GT(judge.count(stage.surfaces[0], TexelState::unlit), 500u);
    const Misses black = judge.compare_with(stage.surfaces[0], 0, 0);
    EXPECT_GT(black.checked, 500u);
    EXPECT_EQ(black.wrong, 0u) << black.text();
    for (const Texel& texel : find_texels(stage.scene, baked.atlas).texels)
        if (baked.atlas.charts[texel.chart].surface == stage.surfaces[0]) {
            EXPECT_EQ(baked.pages[0].map.visibility.pixels[texel.index].x, 0.f) << texel.index;
        }
}

}  // namespace
}  // namespace surimi
