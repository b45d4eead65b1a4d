// SPDX-License-Identifier: Apache-2.0
#include "baker/post/bilinear_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "baker/post/read_average.h"
#include "baker/texel/polygon.h"
#include "runtime/base/parallel.h"
#include "runtime/base/random.h"
#include "tests/support/counted_memory.h"
#include "tests/support/patches.h"

namespace surimi {
namespace {

using test::make_patches;
using test::paint;
using test::Patch;
using test::PatchScene;

constexpr int size = 64;

/// A square of 32 texels, off the texels' grid, on a map of 64.
Patch large_patch() {
    Patch patch;
    patch.texel_corner = Vec2(8.3, 10.6);
    patch.texel_u = Vec2(32, 0);
    patch.texel_v = Vec2(0, 32);
    return patch;
}

struct Page {
    PatchScene made;
    RayScene rays;
    Texels texels;

    explicit Page(const std::vector<Patch>& patches)
        : made(make_patches(patches, false, size)), rays(made.scene), texels(find_texels(made.scene, made.atlas)) {}

    Receivers receivers() const { return {made.scene, made.atlas, texels, rays}; }
    BilinearFit fit(Channel& channel) const { return fit_bilinear(receivers(), {}, channel); }

    /// Painted at the centres of texels, as if measured; as find_texels() has them.
    Channel painted(double (*of)(const Vec3& place)) const {
        Channel channel = paint(made, of)[0];
        for (TexelState& state : channel.state.pixels)
            if (state == TexelState::covered) state = TexelState::filled;
        for (const Texel& texel : texels.texels) channel.state.pixels[texel.index] = TexelState::covered;
        return channel;
    }
};

/// The mean over an even grid of places of a texel that the patch covers.
template <class Function>
double mean_over(const Patch& patch, const Texel& texel, const Function& of) {
    constexpr int side = 40;  // the patch's borders lie between its places
    double sum = 0;
    int count = 0;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const Vec2 at(texel.index % size + (i + 0.5) / side, texel.index / size + (j + 0.5) / side);
            const Vec2 inside = (at - patch.texel_corner) / Vec2(patch.texel_u.x, patch.texel_v.y);
            if (inside.x < 0 || inside.y < 0 || inside.x > 1 || inside.y > 1) continue;
            sum += of(at);
            ++count;
        }
    }
    return sum / count;
}

/// As a sampler reads the map, the place in texels.
double read(const Image<float>& map, const Vec2& at) {
    const Vec2 place = glm::clamp(at - 0.5, Vec2(0), Vec2(size - 1));
    const int x = std::min(static_cast<int>(place.x), size - 2), y = std::min(static_cast<int>(place.y), size - 2);
    const double r = place.x - x, b = place.y - y;
    const auto value = [&](int i, int j) { return static_cast<double>(map.at(i, j)); };
    return (1 - b) * ((1 - r) * value(x, y) + r * value(x + 1, y)) +
           b * ((1 - r) * value(x, y + 1) + r * value(x + 1, y + 1));
}

double ramp(const Vec3& p) {
    return 0.3 + 0.2 * p.x + 0.15 * p.y;
}

double wave(const Vec3& p) {
    return 0.5 + 0.4 * std::sin(17 * p.x + 1) * std::cos(13 * p.y);
}

/// Bands of 0 and 1 with ramps in between.
double penumbra(const Vec3& p) {
    return std::clamp(0.5 + 2 * std::sin(9 * p.x + 2 * p.y), 0.0, 1.0);
}

double even(const Vec3&) {
    return 0.375;
}

bool is_same(const Image<float>& a, const Image<float>& b) {
    return std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(),
                      [](float x, float y) { return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y); });
}

TEST(ReadAverage, IsTheMeanOfReadsOverWhatIsCovered_M67) {
    const Patch patch = large_patch();
    const Page page({patch});
    Image<float> random(size, size);
    for (size_t i = 0; i < random.pixels.size(); ++i) random.pixels[i] = static_cast<float>(unit_double(hash(i)));
    size_t whole = 0, parts = 0;
    for (const Texel& texel : page.texels.texels) {
        const bool is_whole = is_read_as_whole(page.receivers(), texel);
        const ReadAverage average = read_average(page.receivers(), {}, texel);
        ++(is_whole ? whole : parts);
        double sum = 0, weight = 0;
        for (size_t k = 0; k < 9; ++k) {
            const size_t at = texel.index + k / 3 * size + k % 3 - size - 1;
            sum += static_cast<double>(average.weights[k]) * static_cast<double>(random.pixels[at]);
            weight += static_cast<double>(average.weights[k]);
            if (!is_whole) continue;
            EXPECT_NEAR(average.weights[k], read_average_of_whole.weights[k], 1e-6f);
        }
        EXPECT_NEAR(weight, 1, 1e-6);
        const double expected = mean_over(patch, texel, [&](const Vec2& at) { return read(random, at); });
        EXPECT_NEAR(sum, expected, 1e-5) << texel.index;
    }
    EXPECT_EQ(whole, 31u * 31u);
    EXPECT_EQ(parts, 33u * 33u - whole);
}

TEST(ReadAverage, BeyondTheMapItReadsTheBorder_M67) {
    Patch patch;
    patch.texel_u = Vec2(size, 0);
    patch.texel_v = Vec2(0, size);
    const Page page({patch});
    const ReadAverage corner = read_average(page.receivers(), {}, page.texels.texels.front());
    ASSERT_EQ(page.texels.texels.front().index, 0u);
    const std::array<float, 9> expected{0, 0, 0, 0, 49 / 64.f, 7 / 64.f, 0, 7 / 64.f, 1 / 64.f};
    for (size_t k = 0; k < 9; ++k) EXPECT_NEAR(corner.weights[k], expected[k], 1e-6f);
    EXPECT_FALSE(is_read_as_whole(page.receivers(), page.texels.texels.front()));
}

TEST(BilinearFit, WhatReadsAlreadyAverageToIsUnchanged_M67) {
    const Page page({large_patch()});
    Channel channel = page.painted(even);
    const Channel before = channel;
    EXPECT_EQ(page.fit(channel).texels, 0u);
    EXPECT_TRUE(is_same(channel.visibility, before.visibility));
}

TEST(BilinearFit, ARampStaysBitForBitButAtItsBorder_M67) {
    const Page page({large_patch()});
    Channel channel = page.painted(ramp);
    const Channel before = channel;
    page.fit(channel);
    size_t checked = 0;
    for (int y = 15; y < 38; ++y)
        for (int x = 13; x < 36; ++x, ++checked)
            EXPECT_EQ(std::bit_cast<uint32_t>(channel.visibility.at(x, y)),
                      std::bit_cast<uint32_t>(before.visibility.at(x, y)))
                << x << ' ' << y;
    EXPECT_EQ(checked, 23u * 23u);
}

/// Root of the mean square, over whole texels, of what reads average to less what is true on average.
double miss_of(const Page& page, const Channel& channel, double (*of)(const Vec3& place)) {
    const Patch patch = page.made.patches[0];
    double sum = 0;
    for (const Texel& texel : page.texels.texels) {
        const double is = mean_over(patch, texel, [&](const Vec2& at) { return read(channel.visibility, at); });
        const double should = mean_over(patch, texel, [&](const Vec2& at) { return of(patch.place_at(at)); });
        sum += (is - should) * (is - should);
    }
    return std::sqrt(sum / static_cast<double>(page.texels.texels.size()));
}

/// Measured: texels hold averages.
Channel measured(const Page& page, double (*of)(const Vec3& place)) {
    Channel channel = page.painted(of);
    const Patch patch = page.made.patches[0];
    for (const Texel& texel : page.texels.texels)
        channel.visibility.pixels[texel.index] =
            static_cast<float>(mean_over(patch, texel, [&](const Vec2& at) { return of(patch.place_at(at)); }));
    return channel;
}

TEST(BilinearFit, ReadsAverageToWhatWasMeasured_M67) {
    const Page page({large_patch()});
    Channel channel = measured(page, wave);
    const double before = miss_of(page, channel, wave);
    const BilinearFit fit = page.fit(channel);
    const double after = miss_of(page, channel, wave);
    // Of a wave of 17/32 and 13/32 radians a texel K leaves (3 + cos) / 4 each, 0.944, so that lambda keeps
    // 0.1 / (0.944^2 + 0.1) = 0.101 of the miss; more of it at the borders, where texels count by their area.
    EXPECT_LT(after, before * 0.2);
    EXPECT_LT(fit.rms_after, fit.rms_before * 0.15);
    EXPECT_GT(fit.rms_after, fit.rms_before * 0.101);
    EXPECT_NEAR(fit.rms_before, before, 0.1 * before);
    EXPECT_GT(fit.texels, 900u);
}

TEST(BilinearFit, IsLeast_M67) {
    // The sum that is to be least does not fall when any single value is moved.
    const Page page({large_patch()});
    const Channel before = measured(page, penumbra);
    Channel channel = before;
    EXPECT_LE(page.fit(channel).rounds, 60u) << "momentum makes 30 to 40 of 100";
    const auto sum_of = [&](const Channel& tried) {
        double sum = 0;
        for (const Texel& texel : page.texels.texels) {
            const ReadAverage average = read_average(page.receivers(), {}, texel);
            double miss = -static_cast<double>(before.visibility.pixels[texel.index]);
            for (size_t k = 0; k < 9; ++k)
                miss += static_cast<double>(average.weights[k]) *
                        static_cast<double>(tried.visibility.pixels[texel.index + k / 3 * size + k % 3 - size - 1]);
            sum += static_cast<double>(average.area) * miss * miss;
        }
        for (size_t i = 0; i < before.visibility.pixels.size(); ++i) {
            const double change =
                static_cast<double>(tried.visibility.pixels[i]) - static_cast<double>(before.visibility.pixels[i]);
            sum += 0.1 * change * change;
        }
        return sum;
    };
    const double least = sum_of(channel);
    EXPECT_LT(least, 0.7 * sum_of(before));
    size_t tried = 0;
    for (const Texel& texel : page.texels.texels) {
        const float was = before.visibility.pixels[texel.index];
        float& value = channel.visibility.pixels[texel.index];
        if (was == 0 || was == 1 || texel.index % 7 != 0) continue;
        const float fitted = value;
        for (const float step : {-0.01f, 0.01f}) {
            value = std::clamp(fitted + step, 0.f, 1.f);
            if (value == fitted) continue;
            ++tried;
            EXPECT_GT(sum_of(channel), least) << texel.index << ' ' << step;
        }
        value = fitted;
    }
    EXPECT_GT(tried, 60u);
}

TEST(BilinearFit, PlainTexelsKeepTheirBitsAndValuesStayInRange_M67) {
    const Page page({large_patch()});
    Channel channel = measured(page, penumbra);
    const Channel before = channel;
    const BilinearFit fit = page.fit(channel);
    size_t plain = 0, at_bounds = 0;
    for (const Texel& texel : page.texels.texels) {
        const float was = before.visibility.pixels[texel.index], is = channel.visibility.pixels[texel.index];
        EXPECT_TRUE(is >= 0 && is <= 1) << is;
        if (was == 0 || was == 1) {
            ++plain;
            EXPECT_EQ(std::bit_cast<uint32_t>(is), std::bit_cast<uint32_t>(was));
        } else if (is == 0 || is == 1) {
            ++at_bounds;
        }
    }
    EXPECT_GT(plain, 300u);
    EXPECT_GT(at_bounds, 5u) << "bounds are not met";
    EXPECT_GT(fit.texels, 100u);
    for (size_t i = 0; i < before.state.pixels.size(); ++i) EXPECT_EQ(channel.state.pixels[i], before.state.pixels[i]);
}

TEST(BilinearFit, PlainTexelsStayThoughTheirNeighboursWouldMoveThem_M67) {
    // A fiftieth of the first column is covered, and lit; the second is nearly dark, and all that it can do is too
    // little.
    Patch patch = large_patch();
    patch.texel_corner.x = 7.98;
    const Page page({patch});
    Channel channel = page.painted(even);
    for (const Texel& texel : page.texels.texels)
        channel.visibility.pixels[texel.index] = texel.index % size == 7 ? 1 : 0.02f;
    page.fit(channel);
    EXPECT_EQ(channel.visibility.at(8, 30), 0) << "nothing pulls";
    for (int y = 10; y < 43; ++y) EXPECT_EQ(channel.visibility.at(7, y), 1);
}

TEST(BilinearFit, MovesTheGutterAndTexelsWithoutLightButNothingBeyond_M67) {
    const Page page({large_patch()});
    Channel channel = page.painted(ramp);
    // A strip without light whose values a fill took from beside it: a step back.
    for (const Texel& texel : page.texels.texels) {
        const uint32_t x = texel.index % size;
        if (x < 20 || x > 24) continue;
        channel.state.pixels[texel.index] = x < 22 ? TexelState::unlit : TexelState::inside;
        channel.visibility.pixels[texel.index] = 0.5f;
    }
    for (size_t i = 0; i < channel.state.pixels.size(); ++i)
        if (channel.state.pixels[i] == TexelState::filled) channel.visibility.pixels[i] = 0.5f;
    const Channel before = channel;
    page.fit(channel);
    const auto moved = [&](int x, int y) { return channel.visibility.at(x, y) != before.visibility.at(x, y); };
    EXPECT_TRUE(moved(20, 30)) << "unlit, read from x = 19";
    EXPECT_TRUE(moved(24, 30)) << "inside, read from x = 25";
    for (const int x : {21, 22, 23}) EXPECT_FALSE(moved(x, 30)) << x << " is read from nowhere";
    EXPECT_TRUE(moved(7, 30)) << "first ring";
    EXPECT_FALSE(moved(6, 30)) << "second ring";
}

TEST(BilinearFit, SameBytesWhateverTheThreads_M67) {
    const Page page({large_patch()});
    const Channel before = measured(page, penumbra);
    Channel one = before, four = before;
    set_thread_count(1);
    const BilinearFit alone = page.fit(one);
    set_thread_count(4);
    const BilinearFit together = page.fit(four);
    set_thread_count(0);
    EXPECT_GT(alone.texels, 0u);
    EXPECT_EQ(alone.rounds, together.rounds);
    EXPECT_EQ(alone.rms_after, together.rms_after);
    EXPECT_TRUE(is_same(one.visibility, four.visibility));
}

TEST(BilinearFit, WithoutAMeasuredTexelNothingHappens_M67) {
    const Page page({large_patch()});
    Channel channel = page.painted(wave);
    for (TexelState& state : channel.state.pixels)
        if (state == TexelState::covered) state = TexelState::unlit;
    const Channel before = channel;
    BilinearFit fit = page.fit(channel);
    EXPECT_TRUE(is_same(channel.visibility, before.visibility));
    fit.add(page.fit(channel));
    EXPECT_EQ(fit.texels, 0u);
    EXPECT_EQ(fit.rms_before, 0);
    EXPECT_EQ(fit.rms_after, 0);
}

TEST(BilinearFit, AChartThatIsALineIsLeftAlone_M67) {
    Patch line = large_patch();
    line.texel_v = Vec2(0);
    const Page page({line});
    ASSERT_FALSE(page.texels.texels.empty());
    Channel channel{Image<float>(size, size, 1.f), Image<TexelState>(size, size, TexelState::empty)};
    for (const Texel& texel : page.texels.texels) {
        channel.state.pixels[texel.index] = TexelState::covered;
        channel.visibility.pixels[texel.index] = static_cast<float>(unit_double(hash(texel.index)));
    }
    const Channel before = channel;
    EXPECT_EQ(page.fit(channel).texels, 0u);
    EXPECT_TRUE(is_same(channel.visibility, before.visibility));
}

TEST(BilinearFit, KeepsWithinTheBytesThatItForetells) {
    const Page page({large_patch()});
    Channel channel = measured(page, wave);
    test::restart_count();
    page.fit(channel);
    const size_t most = test::most_counted_bytes();
    constexpr size_t slack = 32768;  // of threads and what malloc adds
    EXPECT_LE(most, bilinear_fit_bytes(page.texels) + slack);
    EXPECT_GT(most + slack, bilinear_fit_bytes(page.texels) / 2);
}

TEST(BilinearFit, PagesJoinByTheirArea) {
    BilinearFit all;
    all.add({.texels = 3, .largest_move = 0.1, .rms_before = 0.3, .rms_after = 0.1, .rounds = 9, .area = 10});
    all.add({.texels = 2, .largest_move = 0.2, .rms_before = 0, .rms_after = 0, .rounds = 4, .area = 30});
    EXPECT_EQ(all.texels, 5u);
    EXPECT_EQ(all.largest_move, 0.2);
    EXPECT_DOUBLE_EQ(all.rms_before, 0.15);
    EXPECT_DOUBLE_EQ(all.rms_after, 0.05);
    EXPECT_EQ(all.rounds, 9u);
    EXPECT_EQ(all.area, 40);
}

}  // namespace
}  // namespace surimi
