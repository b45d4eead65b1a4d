// SPDX-License-Identifier: Apache-2.0
// Visibility is a ratio; where there is nothing to divide by, the map still holds numbers (research/ltc.md, section 2:
// H29).
#include "baker/post/ratio.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include "baker/post/fill.h"
#include "baker/post/gutter.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A map of 16 x 12 with one chart of 12 x 8 texels and a margin of 2: a rectangle.
struct Map {
    Scene scene;
    Atlas atlas;
    Texels texels;
    std::vector<IrradianceEstimate> estimates;

    Map() {
        test::add_quad(scene, "quad", {2, 2, 0}, {14, 2, 0}, {14, 10, 0}, {2, 10, 0});
        atlas.width = 16;
        atlas.height = 12;
        atlas.charts = {{0, 1.0}};
        const auto uv = [&](uint32_t corner) {
            return Vec2f(Vec2(scene.surfaces[0].positions[corner]) / Vec2(16, 12));
        };
        SurfaceUv& surface = atlas.surfaces.emplace_back();
        for (const auto& [i, j, k] : scene.surfaces[0].triangles) {
            surface.uv.push_back({uv(i), uv(j), uv(k)});
            surface.chart.push_back(0);
        }
        texels = find_texels(scene, atlas);
        estimates.resize(texels.texels.size());
    }

    /// Divides and fills, and checks what must hold whatever was measured.
    Channel filled() const {
        EXPECT_EQ(texels.texels.size(), 12u * 8u);
        std::feclearexcept(FE_INVALID | FE_DIVBYZERO);
        Channel channel = visibility_channel(texels, estimates);
        fill(scene, atlas, {&texels, 1}, {&channel, 1}, {});
        grow_gutters(texels, channel, all_rings);
        EXPECT_FALSE(std::fetestexcept(FE_INVALID | FE_DIVBYZERO));
        EXPECT_EQ(channel.visibility.pixels.size(), 16u * 12u);
        for (const float v : channel.visibility.pixels) EXPECT_TRUE(v >= 0 && v <= 1) << v;
        for (const TexelState state : channel.state.pixels) EXPECT_NE(state, TexelState::empty);
        return channel;
    }
};

TEST(Ratio, H29_TexelsBehindTheLightTakeTheirNeighboursValue_M3) {
    Map map;
    for (size_t i = 0; i < map.estimates.size(); ++i)
        if (i % 12 < 6) map.estimates[i] = {0.5f, 0.125f, 0.f};  // the right half is behind the light: 0 / 0
    const Channel channel = map.filled();
    for (const float v : channel.visibility.pixels) EXPECT_EQ(v, 0.25f);
    EXPECT_EQ(channel.state.at(12, 5), TexelState::unlit);
    EXPECT_EQ(channel.state.at(3, 5), TexelState::covered);
}

TEST(Ratio, H29_AMapThatNothingLightsIsOne_M3) {
    const Channel channel = Map().filled();
    for (const float v : channel.visibility.pixels) EXPECT_EQ(v, 1.f);
    EXPECT_EQ(channel.state.at(5, 5), TexelState::unlit);
}

TEST(Ratio, H29_TheLeastIrradianceStillDivides_M3) {
    // Texels that see the light edge-on: down to the smallest float, and shadowed ones above unshadowed by rounding.
    constexpr float least = std::numeric_limits<float>::denorm_min(), small = std::numeric_limits<float>::min();
    Map map;
    map.estimates[0] = {least, least, 0.f};
    map.estimates[1] = {least, 0.f, 0.f};
    map.estimates[2] = {small, std::nextafter(small, 1.f), 0.f};
    map.estimates[3] = {4 * least, least, 0.f};
    const Channel channel = map.filled();
    EXPECT_EQ(channel.visibility.at(2, 2), 1.f);
    EXPECT_EQ(channel.visibility.at(3, 2), 0.f);
    EXPECT_EQ(channel.visibility.at(4, 2), 1.f);
    EXPECT_EQ(channel.visibility.at(5, 2), 0.25f);
}

TEST(Ratio, H29_AnyMixtureFills_M3) {
    Random random{29};
    for (int i = 0; i < 50; ++i) {
        Map map;
        const double lit = random.next();
        float low = 1, high = 0;
        for (IrradianceEstimate& e : map.estimates) {
            if (random.next() > lit * lit * lit) continue;
            e.unshadowed = static_cast<float>(std::pow(10, -40 * random.next()));
            e.shadowed = e.unshadowed * static_cast<float>(random.next());
            if (e.unshadowed > 0) low = std::min(low, e.shadowed / e.unshadowed);
            if (e.unshadowed > 0) high = std::max(high, e.shadowed / e.unshadowed);
        }
        if (low > high) low = high = 1;
        const Channel channel = map.filled();
        for (const float v : channel.visibility.pixels) EXPECT_TRUE(v >= low - 1e-6f && v <= high + 1e-6f) << v;
    }
}

}  // namespace
}  // namespace surimi
