// SPDX-License-Identifier: Apache-2.0
// Pages in bands of rows, subtexels, and the memory that both take.
#include <gtest/gtest.h>

#include <cmath>

#include "baker/bake.h"
#include "baker/gather/blocks.h"
#include "baker/gather/downsample.h"
#include "baker/memory.h"
#include "baker/plan.h"
#include "runtime/base/error.h"
#include "tests/support/counted_memory.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr int size = 104;  // a multiple of the tile and of no power of two above it

BakeSettings settings_of(int pages, const GatherSettings& gather) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = size;
    settings.unwrap.atlases = pages;
    settings.gather = gather;
    return settings;
}

/// The sample room with its first monitors alone, or with a third one.
Scene room_with_monitors(size_t count) {
    Scene scene = test::kanikama_room();
    if (count > 2) test::add_monitor(scene, "Monitor_B", 2, {0.3, 2.8, 0.2}, {0.4, 0, 0}, {0, 0, 0.3});
    scene.monitors.resize(count);
    return scene;
}

void expect_same(const Bake& a, const Bake& b) {
    ASSERT_EQ(a.pages.size(), b.pages.size());
    for (size_t p = 0; p < a.pages.size(); ++p) {
        EXPECT_EQ(a.pages[p].map.visibility.pixels, b.pages[p].map.visibility.pixels);
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(a.pages[p].state[c].pixels, b.pages[p].state[c].pixels);
            const auto &x = a.pages[p].irradiance[c].pixels, &y = b.pages[p].irradiance[c].pixels;
            EXPECT_TRUE(std::ranges::equal(x, y, [](const IrradianceEstimate& e, const IrradianceEstimate& f) {
                return e.unshadowed == f.unshadowed && e.shadowed == f.shadowed && e.error == f.error &&
                       e.method == f.method;
            }));
        }
    }
    ASSERT_EQ(a.evidence.size(), b.evidence.size());
    for (size_t m = 0; m < a.evidence.size(); ++m) {
        const GatherStatistics &x = a.evidence[m].statistics, &y = b.evidence[m].statistics;
        EXPECT_EQ(x.rays(), y.rays());
        EXPECT_EQ(x.blocks, y.blocks);
        EXPECT_EQ(x.candidates, y.candidates);
        EXPECT_EQ(x.refined_texels, y.refined_texels);
        EXPECT_EQ(x.error_histogram, y.error_histogram);
    }
}

TEST(Bands, TheSameBytesWhateverTheirHeight) {
    for (const auto& [pages, monitors] : {std::pair<int, size_t>{1, 1}, {2, 3}}) {
        const Scene scene = room_with_monitors(monitors);
        const Bake whole = bake(scene, settings_of(pages, {.error = 0.01, .band_rows = size}), {});
        ASSERT_EQ(whole.pages.size(), static_cast<size_t>(pages));
        for (const int rows : {8, 16, 64})
            expect_same(whole, bake(scene, settings_of(pages, {.error = 0.01, .band_rows = rows}), {}));
    }
}

TEST(Bands, TheSameBytesOfSubtexelsAndForOneThreadAndFour) {
    const Scene scene = room_with_monitors(1);
    for (const int side : {2, 3}) {
        const GatherSettings gather{.error = 0.02, .supersample = side, .band_rows = size};
        set_thread_count(1);
        const Bake one = bake(scene, settings_of(1, gather), {});
        set_thread_count(4);
        GatherSettings in_bands = gather;
        in_bands.band_rows = 8;
        const Bake many = bake(scene, settings_of(1, in_bands), {});
        set_thread_count(0);
        expect_same(one, many);
    }
}

TEST(Bands, HaveAboutAMillionSubtexelsUnlessAskedFor) {
    EXPECT_EQ(rows_of_band(1024, {}), 1024);
    EXPECT_EQ(rows_of_band(16384, {}), 64);
    EXPECT_EQ(rows_of_band(8192, {.supersample = 4}), 8);
    EXPECT_EQ(rows_of_band(16384, {.supersample = 4}), tile_size) << "no less than a tile";
    EXPECT_EQ(rows_of_band(1024, {.band_rows = 24}), 24);
}

bool are_same(const Texels& a, const Texels& b) {
    const bool same_size = a.width == b.width && a.height == b.height && a.texels.size() == b.texels.size();
    for (size_t i = 0; same_size && i < a.texels.size(); ++i) {
        const auto x = a.triangles_of(a.texels[i]), y = b.triangles_of(b.texels[i]);
        if (a.texels[i].index != b.texels[i].index || a.texels[i].chart != b.texels[i].chart || x.size() != y.size())
            return false;
        for (size_t k = 0; k < x.size(); ++k)
            if (x[k].surface != y[k].surface || x[k].triangle != y[k].triangle) return false;
    }
    return same_size;
}

struct Page {
    Scene scene = test::kanikama_room();
    Atlas atlas = unwrap(scene, settings_of(1, {}).unwrap, {});
    Texels texels = find_texels(scene, atlas);
};

TEST(Texels, SubdividedAreThoseOfTheFinerMap) {
    const Page page;
    ASSERT_GT(page.texels.texels.size(), 4000u);
    for (const int side : {1, 2, 3, 4}) {
        Atlas fine = page.atlas;
        fine.width *= side, fine.height *= side;
        const Texels expected = find_texels(page.scene, fine);
        EXPECT_TRUE(are_same(subdivided(page.texels, fine, {0, fine.height}), expected)) << side;
        const Rows rows{17, 90};
        EXPECT_TRUE(are_same(subdivided(page.texels, fine, rows), texels_in(expected, rows))) << side;
    }
}

TEST(Texels, RowsHaveTheirTexels) {
    const Page page;
    const Texels part = texels_in(page.texels, {40, 48});
    ASSERT_FALSE(part.texels.empty());
    const Numbers numbers = numbers_in(page.texels, {40, 48});
    EXPECT_EQ(part.texels.size(), numbers.count());
    EXPECT_GE(part.texels.front().index, uint32_t{40} * size);
    EXPECT_LT(part.texels.back().index, uint32_t{48} * size);
    EXPECT_LT(page.texels.texels[numbers.begin - 1].index, uint32_t{40} * size);
    EXPECT_GE(page.texels.texels[numbers.end].index, uint32_t{48} * size);
    EXPECT_TRUE(are_same(texels_in(page.texels, {-8, size + 16}), page.texels));
    EXPECT_EQ(numbers_in(page.texels, {size, size + 8}).count(), 0u);
}

TEST(Downsample, AveragesLightNotItsRatio_M64) {
    const std::array<IrradianceEstimate, 4> parts{{{4, 1, 0.1f, TexelMethod::split},
                                                   {1, 1, 0.2f, TexelMethod::monte_carlo},
                                                   {0, 0, 0, TexelMethod::none},
                                                   {1, 0.5f, 0, TexelMethod::ray}}};
    const IrradianceEstimate e = average(parts, std::array{1.0, 2.0, 3.0, 2.0});
    EXPECT_FLOAT_EQ(e.unshadowed, 1);
    EXPECT_FLOAT_EQ(e.shadowed, 0.5f) << "the mean of the ratios is 0.58, by area 0.65";
    EXPECT_FLOAT_EQ(e.error, static_cast<float>(std::hypot(1 * 4 * 0.1, 2 * 1 * 0.2) / 8));
    EXPECT_EQ(e.method, TexelMethod::monte_carlo);
}

TEST(Downsample, SubtexelsWithoutAreaHaveNoSayUnlessAllAre_M64) {
    const std::array<IrradianceEstimate, 2> parts{
        {{1, 1, 0.5f, TexelMethod::monte_carlo}, {1, 0, 0, TexelMethod::certificate}}};
    const IrradianceEstimate flat = average(parts, std::array{0.0, 1.0});
    EXPECT_EQ(flat.shadowed, 0);
    EXPECT_EQ(flat.method, TexelMethod::certificate);
    EXPECT_EQ(average(parts, std::array{0.0, 0.0}).shadowed, 0.5f);
}

TEST(Downsample, ATexelIsLitWhereSomeSubtexelIs) {
    const std::array<IrradianceEstimate, 2> parts{{{}, {0.5f, 0.25f, 0, TexelMethod::ray}}};
    EXPECT_EQ(average(parts, std::array{3.0, 1.0}).unshadowed, 0.125f);
    EXPECT_EQ(average(std::span(parts).first(1), std::array{3.0}).method, TexelMethod::none);
    EXPECT_EQ(average({}, {}).unshadowed, 0);
}

TEST(Supersample, AgreesWithTexelsWithinTheErrorsOfBoth_M64) {
    const Scene scene = room_with_monitors(1);
    const double error = 0.004;
    const Bake one = bake(scene, settings_of(1, {.error = error}), {});
    const Bake two = bake(scene, settings_of(1, {.error = error, .supersample = 2}), {});
    const auto c = static_cast<size_t>(scene.monitors[0].channel);
    size_t lit = 0, apart = 0, different = 0;
    for (size_t i = 0; i < one.pages[0].irradiance[c].pixels.size(); ++i) {
        const IrradianceEstimate &a = one.pages[0].irradiance[c].pixels[i], &b = two.pages[0].irradiance[c].pixels[i];
        if (!(a.unshadowed > 0 && b.unshadowed > 0)) continue;
        ++lit;
        const float difference = a.shadowed / a.unshadowed - b.shadowed / b.unshadowed;
        apart += static_cast<double>(std::abs(difference)) > 2 * error;
        different += difference != 0;
    }
    EXPECT_GT(lit, 3000u);
    EXPECT_GT(different, lit / 20) << "subtexels are other points";
    EXPECT_LE(static_cast<double>(apart), 0.002 * static_cast<double>(lit)) << "0.1 % each";
    EXPECT_GT(two.evidence[0].statistics.blocks, 2 * one.evidence[0].statistics.blocks);
    size_t counted = 0;
    for (const auto& method : two.evidence[0].statistics.methods) counted += method.texels;
    EXPECT_EQ(counted, find_texels(scene, two.atlas).texels.size()) << "texels, not subtexels";
}

TEST(Supersample, APlanForetellsRaysOfSubtexels) {
    const Scene scene = room_with_monitors(1);
    GatherSettings gather{.method = Method::monte_carlo, .samples = 16};
    const double one = plan(scene, settings_of(1, gather), {}).rays();
    gather.supersample = 2;
    const double two = plan(scene, settings_of(1, gather), {}).rays();
    const double truth = static_cast<double>(bake(scene, settings_of(1, gather), {}).evidence[0].statistics.rays());
    EXPECT_GT(two, 3.5 * one);
    EXPECT_NEAR(two / truth, 1, 0.1);
}

TEST(Memory, FewerRowsAreTriedUntilTheyKeepTheBound) {
    const auto bytes = [](int rows) { return size_t{1000} + static_cast<size_t>(rows); };
    EXPECT_EQ(most_rows_within(1256, 256, bytes), 256);
    EXPECT_EQ(most_rows_within(1255, 256, bytes), 128);
    EXPECT_EQ(most_rows_within(1008, 256, bytes), 8);
    EXPECT_EQ(most_rows_within(1007, 256, bytes), 0);
    EXPECT_EQ(most_rows_within(1020, 24, bytes), 8);
}

std::string complaint_of(const BakeSettings& settings, const Progress& progress) {
    try {
        bake(room_with_monitors(1), settings, progress);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        return error.what();
    }
    return "";
}

TEST(Memory, WhatCannotBeKeptIsSaidBeforeAnythingIsDone) {
    BakeSettings settings = settings_of(1, {});
    settings.unwrap.width = settings.unwrap.height = 16384;
    settings.memory = size_t{4} << 30;
    const Progress progress{[](std::string_view, double) { ADD_FAILURE() << "work was begun"; }, {}};
    const std::string complaint = complaint_of(settings, progress);
    EXPECT_NE(complaint.find("4096 MiB are allowed"), std::string::npos) << complaint;
    EXPECT_NE(complaint.find("16384 x 16384"), std::string::npos) << complaint;
    EXPECT_NE(complaint.find("--size"), std::string::npos) << complaint;
}

TEST(Memory, WhatTheBakeWouldNeedInTheSmallestBandsIsSaidBeforeLightIsGathered) {
    BakeSettings settings = settings_of(1, {});
    settings.unwrap.texels_per_metre = 8;  // the size is not known beforehand
    settings.memory = 1;
    const Progress progress{[](std::string_view stage, double) {
                                if (stage.starts_with("light")) ADD_FAILURE() << "light was gathered";
                            },
                            {}};
    EXPECT_NE(complaint_of(settings, progress).find("bands of 8 rows"), std::string::npos);
    settings.memory = size_t{1} << 40;
    EXPECT_EQ(complaint_of(settings, {}), "") << "enough";
}

/// A floor in the dark: quick.
Scene dark_floor() {
    Scene scene;
    test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_quad(scene, "Wall", {-9, 1, 9}, {9, 1, 9}, {9, 1, -9}, {-9, 1, -9});
    test::add_monitor(scene, "Monitor_R", 0, {0, 2.5, 0}, {0.8, 0, 0}, {0, 0, 0.45});
    return scene;
}

TEST(Memory, ABakeTakesWhatIsForetold) {
    const Scene scene = dark_floor();
    for (const GatherSettings& gather : {GatherSettings{.error = 0.05}, GatherSettings{.error = 0.05, .band_rows = 8},
                                         GatherSettings{.error = 0.05, .supersample = 2, .band_rows = 256}}) {
        BakeSettings settings = settings_of(1, gather);
        settings.unwrap.width = settings.unwrap.height = 512;
        const PlannedMemory memory = planned_memory(scene, prepare(scene, settings, {}), settings);
        const auto foretold = static_cast<double>(memory.map + memory.texels + memory.silhouettes + memory.passing);
        test::restart_count();
        bake(scene, settings, {});
        const auto counted = static_cast<double>(test::most_counted_bytes());
        EXPECT_GT(foretold, 15e6);
        EXPECT_NEAR(counted / foretold, 1, 0.15) << counted << " of " << foretold;
    }
}

}  // namespace
}  // namespace surimi
