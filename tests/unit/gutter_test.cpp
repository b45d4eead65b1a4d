// SPDX-License-Identifier: Apache-2.0
#include "baker/post/gutter.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surimi {
namespace {

/// Two charts on a map of 16 x 8: columns 0 to 5 and columns 9 to 15 of rows 0 to 5, of values 0.25 and 0.75.
struct TwoCharts {
    Texels texels;
    Channel channel{Image<float>(16, 8, 1.f), Image<TexelState>(16, 8, TexelState::empty)};

    TwoCharts() {
        texels.width = 16;
        texels.height = 8;
        for (uint32_t y = 0; y < 6; ++y)
            for (uint32_t x = 0; x < 16; ++x)
                if (x < 6 || x > 8) add(x, y, x < 6 ? 0 : 1, x < 6 ? 0.25f : 0.75f);
    }
    void add(uint32_t x, uint32_t y, uint32_t chart, float value) {
        texels.texels.push_back({y * 16 + x, chart, 0, 0});
        channel.state.pixels[y * 16 + x] = TexelState::covered;
        channel.visibility.pixels[y * 16 + x] = value;
    }
    size_t count(TexelState state) const {
        return static_cast<size_t>(std::ranges::count(channel.state.pixels, state));
    }
};

TEST(Gutters, TakeTheNearestChartAndTheMapIsFull) {
    TwoCharts map;
    grow_gutters(map.texels, map.channel, all_rings);
    for (int y = 0; y < 6; ++y) {
        EXPECT_EQ(map.channel.visibility.at(6, y), 0.25f);
        EXPECT_EQ(map.channel.visibility.at(8, y), 0.75f);
        EXPECT_EQ(map.channel.state.at(6, y), TexelState::filled);
    }
    EXPECT_EQ(map.count(TexelState::empty), 0u);
    for (const float v : map.channel.visibility.pixels) EXPECT_TRUE(v == 0.25f || v == 0.75f) << v;  // never a mixture
}

TEST(Gutters, GrowAsManyRingsAsAskedFor) {
    TwoCharts map;
    grow_gutters(map.texels, map.channel, 1);
    EXPECT_EQ(map.count(TexelState::filled), 6u + 6u + 7u + 8u);  // columns 6 and 8, row 6 below the charts
    EXPECT_EQ(map.channel.state.at(7, 3), TexelState::empty);
    EXPECT_EQ(map.channel.state.at(3, 7), TexelState::empty);
}

TEST(Gutters, KeepTheRingThatSomethingChangedAndGoOnFromIt) {
    TwoCharts map;
    grow_gutters(map.texels, map.channel, 1);
    for (int x = 0; x < 6; ++x) map.channel.visibility.at(x, 6) = 0.5f;
    grow_gutters(map.texels, map.channel, all_rings);
    EXPECT_EQ(map.channel.visibility.at(2, 6), 0.5f);
    EXPECT_EQ(map.channel.visibility.at(2, 7), 0.5f);
    EXPECT_EQ(map.channel.visibility.at(2, 5), 0.25f);
    EXPECT_EQ(map.channel.visibility.at(12, 7), 0.75f);
    EXPECT_EQ(map.count(TexelState::empty), 0u);
}

TEST(Gutters, OneRingAndThenAllAreAllAtOnce) {
    TwoCharts steps, whole;
    for (TwoCharts* map : {&steps, &whole})
        for (const Texel& t : map->texels.texels)
            map->channel.visibility.pixels[t.index] = static_cast<float>(t.index * 37 % 101) / 101.f;
    grow_gutters(steps.texels, steps.channel, 1);
    grow_gutters(steps.texels, steps.channel, 1);  // nothing to do
    grow_gutters(steps.texels, steps.channel, 2);
    grow_gutters(steps.texels, steps.channel, all_rings);
    grow_gutters(whole.texels, whole.channel, all_rings);
    EXPECT_EQ(steps.channel.visibility.pixels, whole.channel.visibility.pixels);
    EXPECT_EQ(steps.channel.state.pixels, whole.channel.state.pixels);
}

TEST(Gutters, LeaveEveryTexelOfAChartAsItIs) {
    TwoCharts map;
    map.channel.state.at(3, 3) = TexelState::unlit;
    map.channel.state.at(4, 3) = TexelState::inside;
    map.channel.visibility.at(3, 3) = 0.f;
    const Channel before = map.channel;
    grow_gutters(map.texels, map.channel, all_rings);
    for (const Texel& t : map.texels.texels) {
        EXPECT_EQ(map.channel.visibility.pixels[t.index], before.visibility.pixels[t.index]);
        EXPECT_EQ(map.channel.state.pixels[t.index], before.state.pixels[t.index]);
    }
}

TEST(Gutters, OfABlackChartAreBlack) {  // 0 is a value, not "nothing there"
    TwoCharts map;
    for (const Texel& t : map.texels.texels)
        if (t.chart == 0) map.channel.visibility.pixels[t.index] = 0;
    grow_gutters(map.texels, map.channel, all_rings);
    EXPECT_EQ(map.channel.visibility.at(6, 2), 0.f);
    EXPECT_EQ(map.channel.visibility.at(2, 7), 0.f);
}

TEST(Gutters, AreMirroredWhenTheMapIs) {  // scan order must not show
    const auto build = [](bool mirrored) {
        TwoCharts map;
        map.texels.texels.clear();
        map.channel.state = Image<TexelState>(16, 8, TexelState::empty);
        for (uint32_t i = 0; i < 16 * 8; ++i) {
            const uint32_t x = i % 16, y = i / 16;
            if ((x * 7 + y * 3) % 11 > 2) continue;
            map.add(mirrored ? 15 - x : x, y, 0, static_cast<float>(i % 13) / 16.f);
        }
        std::ranges::sort(map.texels.texels, {}, &Texel::index);
        grow_gutters(map.texels, map.channel, all_rings);
        return map;
    };
    const TwoCharts plain = build(false), mirrored = build(true);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_NEAR(plain.channel.visibility.at(x, y), mirrored.channel.visibility.at(15 - x, y), 1e-6);
}

TEST(Gutters, OfAPageWithoutChartsStayEmpty) {
    Texels texels;
    texels.width = texels.height = 4;
    Channel channel{Image<float>(4, 4, 1.f), Image<TexelState>(4, 4, TexelState::empty)};
    grow_gutters(texels, channel, all_rings);
    for (const TexelState s : channel.state.pixels) EXPECT_EQ(s, TexelState::empty);
}

}  // namespace
}  // namespace surimi
