// SPDX-License-Identifier: Apache-2.0
// Lightmaps as other bakers leave them: no alpha, residue of denoisers, shadows brighter than light, RGBE.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "baker/lightmaps/coverage.h"
#include "baker/lightmaps/lightmap_ratio.h"
#include "baker/lightmaps/noise.h"
#include "baker/post/growth.h"
#include "runtime/base/error.h"
#include "runtime/base/parallel.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr int side = 96;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Two square charts on a map, the left one lit, and half in shadow by a soft edge; the right one sinks below the
/// monitor's horizon at its middle.
struct TwoCharts {
    LightPair pair;
    Image<float> truth{side, side};
    Image<uint8_t> mask{side, side};
    static constexpr int margin = 6, left_end = 44, right_begin = 52;

    static bool is_covered(int x, int y) {
        return y >= margin && y < side - margin &&
               ((x >= margin && x < left_end) || (x >= right_begin && x < side - margin));
    }
    static double unshadowed(int x, int y) {
        if (x < left_end) return 0.3 / (1 + std::pow((x - 25) / 30.0, 2) + std::pow((y - 48) / 40.0, 2));
        return std::max(0.0, 0.05 * (70.5 - x) / 18);
    }
    static double visibility(int x, int y) {
        return x < left_end ? std::clamp((y - 40) / 12.0, 0.0, 1.0) : std::clamp((y - 20) / 30.0, 0.0, 1.0);
    }

    TwoCharts() {
        pair.shadowed.light = pair.unshadowed.light = Image<float>(side, side);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                if (!is_covered(x, y)) continue;
                mask.at(x, y) = 1;
                truth.at(x, y) = static_cast<float>(visibility(x, y));
                pair.unshadowed.light.at(x, y) = static_cast<float>(unshadowed(x, y));
                pair.shadowed.light.at(x, y) = static_cast<float>(unshadowed(x, y) * visibility(x, y));
            }
    }
    std::span<const LightPair> pairs() const { return {&pair, 1}; }
    RatioOfLightmaps divide(const LightmapRatioSettings& settings = {}, bool with_mask = true) const {
        return ratio_of(pair, find_coverage(pairs(), with_mask ? mask : Image<uint8_t>(), settings.threshold),
                        settings);
    }
    /// The largest error over texels with light.
    double worst(const Image<float>& visibility) const {
        double most = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                if (is_covered(x, y) && unshadowed(x, y) > 0)
                    most = std::max(most, std::abs(static_cast<double>(visibility.at(x, y) - truth.at(x, y))));
        return most;
    }
    /// Over the last columns with light, where there is hardly any.
    double error_at_horizon(const Image<float>& visibility) const {
        double sum = 0;
        for (int y = margin; y < side - margin; ++y)
            for (int x = 64; x <= 70; ++x)
                sum += std::pow(static_cast<double>(visibility.at(x, y) - truth.at(x, y)), 2) / (7 * 84);
        return std::sqrt(sum);
    }
};

bool is_visibility(const Image<float>& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return v >= 0 && v <= 1; });
}

/// As the shared exponent of Ward's format rounds a grey value.
float as_rgbe(float value) {
    if (!(value > 0)) return 0;
    int exponent = 0;
    std::frexp(value, &exponent);
    return std::ldexp(std::floor(std::ldexp(value, 8 - exponent)), exponent - 8);
}

TEST(LightmapRatio, CleanLightmapsGiveTheRatioItself) {
    const TwoCharts charts;
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_LT(charts.worst(ratio.channel.visibility), 1e-6);
    EXPECT_TRUE(is_visibility(ratio.channel.visibility));
    EXPECT_EQ(ratio.faults.above_one + ratio.faults.noisy + ratio.faults.not_finite, 0U);
    EXPECT_EQ(ratio.channel.state.at(20, 50), TexelState::covered);
    EXPECT_EQ(ratio.channel.state.at(85, 50), TexelState::unlit);  // behind the horizon
    EXPECT_EQ(ratio.channel.state.at(48, 50), TexelState::filled);
}

TEST(LightmapRatio, WhatTheMonitorCannotLightContinuesItsOwnChart) {
    const TwoCharts charts;
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_EQ(ratio.faults.without_light, 19U * 84U);
    for (const int y : {10, 30, 60, 80})  // right of the horizon, the values left of it
        EXPECT_NEAR(ratio.channel.visibility.at(80, y), TwoCharts::visibility(70, y), 0.2);
    // Gutters are the chart's own: at y = 30 the left chart is dark and the right one a third lit.
    EXPECT_LT(ratio.channel.visibility.at(45, 30), 0.01);
    EXPECT_GT(ratio.channel.visibility.at(51, 30), 0.25);
}

TEST(LightmapRatio, ZeroDenominatorsAreFilledNotDivided) {
    TwoCharts charts;
    for (int i = 0; i < 10; ++i) {
        charts.pair.unshadowed.light.at(20 + i, 80) = 0;
        charts.pair.shadowed.light.at(20 + i, 80) = 0.1F;
    }
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_EQ(ratio.faults.shadow_of_nothing, 10U);
    EXPECT_LT(charts.worst(ratio.channel.visibility), 1e-6);  // around them all is lit
}

TEST(LightmapRatio, ResidueOfADenoiserIsNoLight) {
    TwoCharts charts;
    Image<float>& n = charts.pair.shadowed.light;
    Image<float>& d = charts.pair.unshadowed.light;
    for (size_t i = 0; i < d.pixels.size(); ++i) {
        d.pixels[i] += 1e-10F * static_cast<float>(1 + i % 7);
        n.pixels[i] += 1e-10F * static_cast<float>(1 + i % 5);
    }
    const RatioOfLightmaps with_mask = charts.divide();
    EXPECT_GE(with_mask.faults.residue, 19U * 84U);
    EXPECT_LT(charts.worst(with_mask.channel.visibility), 0.05);
    // Without mask and alpha, light tells where charts are: those that have any.
    const Coverage coverage = find_coverage(charts.pairs(), {}, 1e-4);
    EXPECT_EQ(coverage.source, CoverageSource::light);
    EXPECT_EQ(coverage.islands, 2U);
    EXPECT_EQ(coverage.texels, 84U * (38U + 19U));
    EXPECT_LT(charts.worst(charts.divide({}, false).channel.visibility), 0.05);
}

TEST(LightmapRatio, ValuesAboveOneAreClampedBeforeTheyAreAveraged) {
    TwoCharts charts;
    for (int y = TwoCharts::margin; y < side - TwoCharts::margin; ++y)  // a bright rim, as of resized lightmaps
        charts.pair.shadowed.light.at(TwoCharts::margin, y) =
            20 * charts.pair.unshadowed.light.at(TwoCharts::margin, y);
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_EQ(ratio.faults.above_one, 84U);
    EXPECT_NEAR(ratio.faults.largest_ratio, 20, 1e-4);
    EXPECT_TRUE(is_visibility(ratio.channel.visibility));
    const auto lines = describe(ratio.faults, "red", find_coverage(charts.pairs(), charts.mask, 1e-4));
    ASSERT_GE(lines.size(), 2U);
    EXPECT_NE(lines[0].find("84 texels"), std::string::npos) << lines[0];
    EXPECT_NE(lines[1].find("20 times"), std::string::npos) << lines[1];
}

TEST(LightmapRatio, AlphaTellsWhereChartsAreUnlessItIsTheSameEverywhere) {
    TwoCharts charts;
    charts.pair.unshadowed.alpha = Image<float>(side, side);
    std::copy(charts.mask.pixels.begin(), charts.mask.pixels.end(), charts.pair.unshadowed.alpha.pixels.begin());
    const Coverage by_alpha = find_coverage(charts.pairs(), {}, 1e-4);
    EXPECT_EQ(by_alpha.source, CoverageSource::alpha);
    EXPECT_EQ(by_alpha.texels, 84U * 76U);
    charts.pair.unshadowed.alpha = Image<float>(side, side, 1);
    EXPECT_EQ(find_coverage(charts.pairs(), {}, 1e-4).source, CoverageSource::light);
    EXPECT_EQ(find_coverage(charts.pairs(), charts.mask, 1e-4).source, CoverageSource::mask);
}

TEST(LightmapRatio, NotFiniteAndNegativeLightNeverLeaves) {
    TwoCharts charts;
    charts.pair.shadowed.light.at(20, 60) = nan;
    charts.pair.unshadowed.light.at(22, 60) = std::numeric_limits<float>::infinity();
    charts.pair.shadowed.light.at(24, 60) = -1;
    charts.pair.unshadowed.light.at(26, 60) = -1;
    charts.pair.unshadowed.light.at(1, 1) = nan;  // outside of charts
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_EQ(ratio.faults.not_finite, 2U);
    EXPECT_EQ(ratio.faults.negative, 2U);
    EXPECT_TRUE(is_visibility(ratio.channel.visibility));
    EXPECT_TRUE(is_visibility(charts.divide({}, false).channel.visibility));
}

TEST(LightmapRatio, RoundingOfRgbeStaysBelowItsStep) {
    TwoCharts charts;
    for (Lightmap* map : {&charts.pair.shadowed, &charts.pair.unshadowed}) {
        map->relative_step = 0x1p-7;
        for (float& value : map->light.pixels) value = as_rgbe(value);
    }
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_LT(charts.worst(ratio.channel.visibility), 0.01);
    EXPECT_LT(ratio.faults.noisy, 30U);  // none but where light goes out
}

TEST(LightmapRatio, NoiseIsMeasuredFromTheLightmapItself_M68) {
    TwoCharts charts;
    const double sigma = 2e-3;
    for (size_t i = 0; i < charts.mask.pixels.size(); ++i) {
        double normal = -6;  // twelve uniform numbers: variance 1
        for (uint64_t k = 0; k < 12; ++k) normal += unit_double(hash(i, k));
        if (charts.mask.pixels[i] > 0) charts.pair.unshadowed.light.pixels[i] += static_cast<float>(sigma * normal);
    }
    const Coverage coverage = find_coverage(charts.pairs(), charts.mask, 1e-4);
    const Image<float> noise = noise_of(charts.pair.unshadowed, coverage);
    double sum = 0, count = 0;
    for (int y = 10; y < 86; ++y)
        for (int x = 10; x < 40; ++x) sum += static_cast<double>(noise.at(x, y)), ++count;
    EXPECT_NEAR(sum / count, sigma, 0.1 * sigma);
    EXPECT_EQ(noise.at(48, 48), 0);  // between the charts
    // Where light is less than ten times its noise no ratio is taken.
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_GT(ratio.faults.noisy, 300U);
    const RatioOfLightmaps noisy = charts.divide({.threshold = 1e-4, .noise = 10});
    std::printf("at the horizon: RMSE %.4f, with noise %.4f\n", charts.error_at_horizon(ratio.channel.visibility),
                charts.error_at_horizon(noisy.channel.visibility));
    EXPECT_LT(charts.error_at_horizon(ratio.channel.visibility),
              0.7 * charts.error_at_horizon(noisy.channel.visibility));
}

TEST(LightmapRatio, SmoothLightHasNoNoise_M68) {
    const TwoCharts charts;
    const Image<float> noise = noise_of(charts.pair.unshadowed, find_coverage(charts.pairs(), charts.mask, 1e-4));
    for (int y = 8; y < 88; ++y)
        for (int x = 8; x < 42; ++x) EXPECT_LT(noise.at(x, y), 2e-3 * TwoCharts::unshadowed(x, y)) << x << " " << y;
}

TEST(LightmapRatio, AnIslandWithoutLightBlocksNothing) {
    TwoCharts charts;
    for (int y = 0; y < side; ++y)
        for (int x = TwoCharts::right_begin; x < side; ++x) charts.pair.unshadowed.light.at(x, y) = 0;
    const RatioOfLightmaps ratio = charts.divide();
    EXPECT_EQ(ratio.faults.dark_islands, 1U);
    EXPECT_EQ(ratio.channel.visibility.at(70, 20), 1);
}

TEST(LightmapRatio, LightmapsWithoutAnyLightAreAnError) {
    TwoCharts charts;
    for (float& value : charts.pair.unshadowed.light.pixels) value = 0;
    try {
        charts.divide();
        FAIL() << "divided by nothing";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::nothing_to_bake);
        EXPECT_NE(std::string(error.what()).find("6384 covered texels"), std::string::npos) << error.what();
    }
}

TEST(LightmapRatio, KanikamasFormulaIsReproduced) {
    LightPair pair;
    pair.shadowed.light = Image<float>(4, 1);
    pair.unshadowed.light = Image<float>(4, 1);
    pair.shadowed.light.pixels = {0.5F, 0.5F, 2e-5F, 3.0F};
    pair.unshadowed.light.pixels = {0, 1.0F, 5e-5F, 2.0F};
    const Image<float> ratio = kanikama_ratio(pair);
    EXPECT_FLOAT_EQ(ratio.pixels[0], 0);
    EXPECT_FLOAT_EQ(ratio.pixels[1], 0.5F);
    EXPECT_FLOAT_EQ(ratio.pixels[2], 0.2F);  // over 1e-4
    EXPECT_FLOAT_EQ(ratio.pixels[3], 1.5F);  // not clamped
}

TEST(LightmapRatio, StepsOfFormats) {
    Lightmap png;
    png.code_step = 1 / 255.0;
    png.is_srgb = true;
    EXPECT_NEAR(step_at(png, 0), 1 / 255.0 / 12.92, 1e-9);
    EXPECT_NEAR(step_at(png, 1), 0.0089, 2e-4);
    png.is_srgb = false;
    EXPECT_NEAR(step_at(png, 0.3), 1 / 255.0, 1e-12);
    Lightmap half;
    half.relative_step = 0x1p-10;
    EXPECT_NEAR(step_at(half, 0.5), 0x1p-11, 1e-12);
}

TEST(LightmapRatio, TheSameBytesForAnyNumberOfThreads) {
    const TwoCharts charts;
    set_thread_count(1);
    const auto one = charts.divide().channel.visibility.pixels;
    set_thread_count(3);
    const auto three = charts.divide().channel.visibility.pixels;
    set_thread_count(0);
    EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace surimi
