// SPDX-License-Identifier: Apache-2.0
#include "baker/post/stitch.h"

#include <gtest/gtest.h>

#include <bit>

#include "baker/post/bounded_solve.h"
#include "runtime/base/parallel.h"
#include "runtime/base/random.h"
#include "tests/support/patches.h"

namespace surimi {
namespace {

using test::largest_jump;
using test::make_patches;
using test::paint;
using test::Patch;

constexpr double code = 1.0 / 255;

/// Two squares of 1 m side by side, which meet at x = 1; the right one is 0.1 darker, at another phase of the texels.
std::vector<Patch> pair_of_squares() {
    Patch left, right;
    left.texel_corner = Vec2(4, 4);
    right.corner = Vec3(1, 0, 0);
    right.texel_corner = Vec2(30.3, 7.6);
    right.offset = -0.1;
    return {left, right};
}

double ramp(const Vec3& p) {
    return 0.3 + 0.2 * p.x + 0.15 * p.y;
}

double step(const Vec3& p) {
    return p.y > 0.5 ? 1 : 0;
}

bool is_same(float a, float b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

/// Whether a seam at x = 1 could be read from this texel: at most 1.5 texels from it.
bool is_near_seam(const Patch& patch, const Vec2& texel, double reach) {
    const Vec3 place = patch.place_at(texel);
    const double texel_size = glm::length(patch.u) / glm::length(patch.texel_u);
    return std::abs(place.x - 1) <= reach * texel_size;
}

/// How many texels of the charts changed, all of which must be near the seam.
size_t moved_texels(const test::PatchScene& made, const std::vector<Channel>& before,
                    const std::vector<Channel>& after) {
    size_t moved = 0;
    for (size_t p = 0; p < before.size(); ++p) {
        for (int y = 0; y < made.atlas.height; ++y) {
            for (int x = 0; x < made.atlas.width; ++x) {
                if (is_same(before[p].visibility.at(x, y), after[p].visibility.at(x, y))) continue;
                ++moved;
                bool is_near = false;
                for (const Patch& patch : made.patches)
                    is_near = is_near ||
                              (patch.page == static_cast<int>(p) && is_near_seam(patch, Vec2(x + 0.5, y + 0.5), 1.5));
                EXPECT_TRUE(is_near) << x << ' ' << y;
            }
        }
    }
    return moved;
}

void expect_stitched(const std::vector<Patch>& patches, bool is_one_surface) {
    const auto made = make_patches(patches, is_one_surface, 80);
    const auto before = paint(made, ramp);
    auto pages = before;
    const Seams seams = find_seams(made.scene, made.atlas);
    ASSERT_EQ(seams.pieces.size(), 1u);
    const StitchReport report = stitch(made.atlas, seams, pages);
    const Vec3 low(1, 0, 0), high(1, 1, 0);
    const double was = largest_jump(before, patches[0], patches[1], low, high);
    const double is = largest_jump(pages, patches[0], patches[1], low, high);
    EXPECT_GT(was, 0.09);
    EXPECT_LE(is, code);
    EXPECT_NEAR(report.before.largest, was, 0.01);
    EXPECT_NEAR(report.after.largest, is, code);
    EXPECT_LE(report.after.percentile_99, report.after.largest);
    EXPECT_EQ(report.texels, moved_texels(made, before, pages));
    EXPECT_GT(report.texels, 30u);
    EXPECT_GT(report.largest_move, 0.04);
    EXPECT_EQ(report.pieces, 1u);
    EXPECT_NEAR(report.metres, 1, 1e-9);
}

TEST(Stitch, WhereOneSideIsInsideOtherGeometryTheyNeedNotAgree_M60) {
    const auto made = make_patches(pair_of_squares(), false, 80);
    auto before = paint(made, ramp);
    for (TexelState& state : before[0].state.pixels) {
        const auto index = static_cast<size_t>(&state - before[0].state.pixels.data());
        if (state == TexelState::covered && index % 80 >= 28) state = TexelState::inside;  // the right square
    }
    auto pages = before;
    const StitchReport report = stitch(made.atlas, find_seams(made.scene, made.atlas), pages);
    EXPECT_EQ(report.pieces, 1u);
    EXPECT_EQ(report.texels, 0u);
    EXPECT_EQ(report.before.largest, 0) << "none of it can be seen";
    for (size_t t = 0; t < pages[0].visibility.pixels.size(); ++t)
        EXPECT_TRUE(is_same(before[0].visibility.pixels[t], pages[0].visibility.pixels[t]));
}

TEST(Stitch, ChartsSurfacesAndPagesAgreeToACodeAndOtherTexelsKeepTheirBits_M60) {
    auto patches = pair_of_squares();
    expect_stitched(patches, true);
    expect_stitched(patches, false);
    patches[1].page = 1;
    expect_stitched(patches, false);
}

TEST(Stitch, ChartsMayBeTurnedMirroredAndOfOtherDensity) {
    auto patches = pair_of_squares();
    patches[1].texel_u = Vec2(0, 16), patches[1].texel_v = Vec2(-16, 0), patches[1].texel_corner = Vec2(60.2, 10.7);
    expect_stitched(patches, false);  // by a quarter
    patches[1].texel_u = Vec2(-16, 0), patches[1].texel_v = Vec2(0, 16);
    expect_stitched(patches, false);  // mirrored
    patches[1].texel_u = Vec2(13, 9), patches[1].texel_v = Vec2(-9, 13), patches[1].texel_corner = Vec2(50.2, 20.7);
    expect_stitched(patches, false);  // askew
    patches[1].texel_u = Vec2(41, 0), patches[1].texel_v = Vec2(0, 41), patches[1].texel_corner = Vec2(30.4, 30.1);
    expect_stitched(patches, false);  // finer
    patches[1].texel_u = Vec2(5, 0), patches[1].texel_v = Vec2(0, 5);
    expect_stitched(patches, false);  // coarser
}

TEST(Stitch, WhereNothingJumpsNothingChanges) {
    auto patches = pair_of_squares();
    patches[1].offset = 0;
    patches[1].texel_corner = Vec2(30, 7);  // the same phase: both sides say the same
    const auto made = make_patches(patches);
    for (const auto of : {ramp, step}) {
        const auto before = paint(made, of);
        auto pages = before;
        const StitchReport report = stitch(made.atlas, find_seams(made.scene, made.atlas), pages);
        EXPECT_LT(report.before.largest, 1e-6);
        if (of == step) {
            EXPECT_EQ(report.texels, 0u);
            EXPECT_EQ(moved_texels(made, before, pages), 0u);
        }
    }
}

TEST(Stitch, FullLightAndFullShadowStayWhereBothSidesAgree_M61) {
    auto patches = pair_of_squares();
    patches[1].offset = 0;  // but for the phase of the texels both sides agree
    const auto made = make_patches(patches);
    const auto before = paint(made, step);
    auto pages = before;
    const StitchReport report = stitch(made.atlas, find_seams(made.scene, made.atlas), pages);
    EXPECT_GT(report.before.largest, 0.2);
    EXPECT_LT(report.after.largest, 0.25 * report.before.largest);
    EXPECT_GT(report.texels, 3u);
    for (int y = 0; y < made.atlas.height; ++y) {
        for (int x = 0; x < made.atlas.width; ++x) {
            const float v = pages[0].visibility.at(x, y);
            EXPECT_TRUE(v >= 0 && v <= 1) << v;
            for (const Patch& patch : patches) {
                if (!is_near_seam(patch, Vec2(x + 0.5, y + 0.5), 2)) continue;
                const double away = std::abs(patch.place_at(Vec2(x + 0.5, y + 0.5)).y - 0.5) * 16;
                if (away > 2.5) {
                    EXPECT_TRUE(is_same(v, before[0].visibility.at(x, y))) << x << ' ' << y;
                }
            }
        }
    }
}

TEST(Stitch, MeasuredTexelsStayAndGuessesMove_M60) {
    const auto patches = pair_of_squares();
    const auto made = make_patches(patches);
    auto pages = paint(made, ramp);
    for (int y = 0; y < 64; ++y)  // the right square is not lit: its values are its neighbours'
        for (int x = 27; x < 64; ++x)
            if (pages[0].state.at(x, y) == TexelState::covered) pages[0].state.at(x, y) = TexelState::unlit;
    const auto before = pages;
    stitch(made.atlas, find_seams(made.scene, made.atlas), pages);
    double measured = 0, guessed = 0;
    for (size_t i = 0; i < before[0].visibility.pixels.size(); ++i) {
        const double move =
            std::abs(static_cast<double>(before[0].visibility.pixels[i] - pages[0].visibility.pixels[i]));
        double& largest = before[0].state.pixels[i] == TexelState::covered ? measured : guessed;
        largest = std::max(largest, move);
    }
    EXPECT_GT(guessed, 0.07);
    EXPECT_GT(measured, 0);
    EXPECT_LT(measured, 0.03);
}

TEST(Stitch, EmptyTexelsKeepTheirBits) {
    const auto made = make_patches(pair_of_squares());
    auto pages = paint(made, ramp);
    for (TexelState& state : pages[0].state.pixels)
        if (state == TexelState::filled) state = TexelState::empty;
    const auto before = pages;
    EXPECT_GT(stitch(made.atlas, find_seams(made.scene, made.atlas), pages).texels, 0u);
    for (size_t i = 0; i < before[0].visibility.pixels.size(); ++i)
        if (before[0].state.pixels[i] == TexelState::empty) {
            EXPECT_TRUE(is_same(before[0].visibility.pixels[i], pages[0].visibility.pixels[i]));
        }
}

TEST(Stitch, IsTheSameOnOneAndFourThreads) {
    std::vector<Patch> patches;
    for (int i = 0; i < 12; ++i) {
        Patch patch;
        patch.corner = Vec3(i % 4, i / 4 * (i % 2 == 0 ? 1 : 3), 0);  // some meet, some are alone
        patch.texel_corner = Vec2(4.1 + 30 * (i % 4), 4.3 + 30 * (i / 4));
        patch.offset = 0.05 * (i % 5);
        patches.push_back(patch);
    }
    const auto made = make_patches(patches, false, 128);
    const auto run = [&](int threads) {
        set_thread_count(threads);
        auto pages = paint(made, ramp);
        EXPECT_GT(stitch(made.atlas, find_seams(made.scene, made.atlas), pages).texels, 0u);
        set_thread_count(0);
        return pages;
    };
    const auto one = run(1), four = run(4);
    for (size_t i = 0; i < one[0].visibility.pixels.size(); ++i)
        ASSERT_TRUE(is_same(one[0].visibility.pixels[i], four[0].visibility.pixels[i]));
}

TEST(Stitch, WithoutSeamsOrMapsNothingIsDone) {
    const StitchReport report = stitch({}, {}, {});
    EXPECT_EQ(report.texels, 0u);
    EXPECT_EQ(report.before.largest, 0);
}

TEST(BoundedSolve, MeetsTheConditionsOfTheLeastPlaceBetweenBounds_M61) {
    size_t at_bounds = 0, free = 0;
    for (uint64_t round = 0; round < 200; ++round) {
        constexpr uint32_t size = 12;
        auto random = [&, i = uint64_t{0}]() mutable { return 2 * unit_double(hash(round, ++i)) - 1; };
        BoundedLeastSquares problem;
        for (uint32_t e = 0; e < size; ++e) {
            for (uint32_t u = 0; u < size; ++u) problem.entries.push_back({e, u, random()});
            problem.right.push_back(3 * random());
            problem.weights.push_back(0.1);
            problem.low.push_back(std::min(0.0, random()));
            problem.high.push_back(std::max(0.0, problem.low.back() + 1));
        }
        const std::vector<double> x = solve(problem);
        std::vector<double> left = problem.right, slope(size);  // of what is to be least, halved
        for (const auto& [e, u, value] : problem.entries) left[e] -= value * x[u];
        for (const auto& [e, u, value] : problem.entries) slope[u] -= value * left[e];
        for (uint32_t u = 0; u < size; ++u) {
            slope[u] += problem.weights[u] * x[u];
            EXPECT_GE(x[u], problem.low[u]);
            EXPECT_LE(x[u], problem.high[u]);
            if (x[u] > problem.low[u]) {
                EXPECT_LT(slope[u], 1e-6);  // else less would be better
            }
            if (x[u] < problem.high[u]) {
                EXPECT_GT(slope[u], -1e-6);
            }
            const bool is_bound = x[u] == problem.low[u] || x[u] == problem.high[u];
            ++(is_bound ? at_bounds : free);
        }
    }
    EXPECT_GT(at_bounds, 200u);
    EXPECT_GT(free, 200u);
}

}  // namespace
}  // namespace surimi
