// SPDX-License-Identifier: Apache-2.0
#include "baker/post/fill.h"

#include <gtest/gtest.h>

#include "baker/post/ratio.h"

namespace surimi {
namespace {

/// Two charts of different surfaces on a map of 16 x 8: columns 0 to 5 and columns 9 to 15 of rows 0 to 5.
struct TwoCharts {
    Atlas atlas;
    Texels texels;
    Image<float> visibility{16, 8, 1.f};
    Image<TexelState> state{16, 8, TexelState::empty};

    TwoCharts() {
        atlas.width = texels.width = 16;
        atlas.height = texels.height = 8;
        atlas.surfaces.resize(2);
        atlas.charts = {{0, 1.0}, {1, 1.0}};
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 16; ++x)
                if (x < 6 || x > 8) texels.texels.push_back({static_cast<uint32_t>(y * 16 + x), x < 6 ? 0u : 1u, 0, 0});
        for (const Texel& t : texels.texels) {
            state.pixels[t.index] = TexelState::covered;
            visibility.pixels[t.index] = t.chart == 0 ? 0.25f : 0.75f;
        }
    }
};

TEST(Fill, UnlitTexelsTakeTheirOwnChartsValue) {
    TwoCharts map;
    for (int y = 0; y < 6; ++y) map.state.at(9, y) = TexelState::unlit, map.visibility.at(9, y) = 1;
    fill(map.atlas, map.texels, map.visibility, map.state);
    for (int y = 0; y < 6; ++y) {
        EXPECT_EQ(map.visibility.at(9, y), 0.75f);
        EXPECT_EQ(map.state.at(9, y), TexelState::unlit);
    }
}

TEST(Fill, GuttersTakeTheNearestChartAndTheMapIsFull) {
    TwoCharts map;
    fill(map.atlas, map.texels, map.visibility, map.state);
    for (int y = 0; y < 6; ++y) {
        EXPECT_EQ(map.visibility.at(6, y), 0.25f);
        EXPECT_EQ(map.visibility.at(8, y), 0.75f);
        EXPECT_EQ(map.state.at(6, y), TexelState::filled);
    }
    for (const TexelState s : map.state.pixels) EXPECT_NE(s, TexelState::empty);
    for (const float v : map.visibility.pixels) EXPECT_TRUE(v == 0.25f || v == 0.75f) << v;  // never a mixture
}

TEST(Fill, AnUnlitChartTakesItsSurfacesMean) {
    TwoCharts map;
    map.atlas.charts[1].surface = 0;
    for (const Texel& t : map.texels.texels)
        if (t.chart == 1) map.state.pixels[t.index] = TexelState::unlit;
    fill(map.atlas, map.texels, map.visibility, map.state);
    EXPECT_EQ(map.visibility.at(12, 3), 0.25f);
}

TEST(Fill, AnUnlitSurfaceIsOneNotZero) {
    TwoCharts map;
    for (const Texel& t : map.texels.texels) {
        if (t.chart == 1) map.state.pixels[t.index] = TexelState::unlit, map.visibility.pixels[t.index] = 0.1f;
    }
    fill(map.atlas, map.texels, map.visibility, map.state);
    EXPECT_EQ(map.visibility.at(12, 3), 1.f);
}

TEST(Fill, IsMirroredWhenTheMapIs) {  // scan order must not show
    const auto build = [](bool mirrored) {
        TwoCharts map;
        map.texels.texels.clear();
        map.state = Image<TexelState>(16, 8, TexelState::empty);
        for (int i = 0; i < 16 * 8; ++i) {
            const int x = i % 16, y = i / 16;
            if ((x * 7 + y * 3) % 11 > 2) continue;
            const int at = mirrored ? 15 - x : x;
            map.texels.texels.push_back({static_cast<uint32_t>(y * 16 + at), 0, 0, 0});
            map.state.at(at, y) = TexelState::covered;
            map.visibility.at(at, y) = static_cast<float>(i % 13) / 16.f;
        }
        std::sort(map.texels.texels.begin(), map.texels.texels.end(),
                  [](auto& a, auto& b) { return a.index < b.index; });
        fill(map.atlas, map.texels, map.visibility, map.state);
        return map;
    };
    const TwoCharts plain = build(false), mirrored = build(true);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_NEAR(plain.visibility.at(x, y), mirrored.visibility.at(15 - x, y), 1e-6);
}

TEST(Fill, AMapWithoutASingleMeasuredTexelIsOne) {
    TwoCharts map;
    for (TexelState& s : map.state.pixels)
        if (s == TexelState::covered) s = TexelState::unlit;
    fill(map.atlas, map.texels, map.visibility, map.state);
    for (const float v : map.visibility.pixels) EXPECT_EQ(v, 1.f);
}

TEST(VisibilityChannel, IsShadowedOverUnshadowedAndMarksUnlitTexels_M3) {
    TwoCharts map;
    std::vector<IrradianceEstimate> estimates(map.texels.texels.size());
    estimates[0] = {2.f, 0.5f, 0.f};
    estimates[1] = {1e-20f, 1e-20f, 0.f};
    const Channel channel = visibility_channel(map.texels, estimates);
    EXPECT_EQ(channel.visibility.pixels[map.texels.texels[0].index], 0.25f);
    EXPECT_EQ(channel.visibility.pixels[map.texels.texels[1].index], 1.f);
    EXPECT_EQ(channel.state.pixels[map.texels.texels[1].index], TexelState::covered);
    EXPECT_EQ(channel.state.pixels[map.texels.texels[2].index], TexelState::unlit);
    EXPECT_EQ(channel.state.at(7, 7), TexelState::empty);
}

}  // namespace
}  // namespace surimi
