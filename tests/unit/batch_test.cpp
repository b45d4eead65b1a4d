// SPDX-License-Identifier: Apache-2.0
// How batches behave: cut anywhere, partly wanted, partly not a number.
#include "runtime/batch/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "runtime/base/error.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
constexpr std::array<Precision, 2> precisions = {Precision::full, Precision::mixed};
const std::vector<Vec3> light = {{-0.5, 1, -2}, {0.5, 1, -2}, {0.5, 2, -1.9}, {-0.5, 2, -1.9}};  // shines to +z

class Batch : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override { use_instruction_set(GetParam()); }
    void TearDown() override { use_instruction_set(""); }
};

/// Points around the light: before and behind it, near and far, some of them on it.
PointBatch some_points(size_t count) {
    Random random{5};
    const auto number = [&] { return 2 * random.next() - 1; };
    PointBatch points;
    for (size_t i = 0; i < count; ++i) {
        const double y = number(), z = number();
        const Vec3 normal(number(), number(), number()), view(number(), number(), number());
        points.position.push_back(i % 5 == 4 ? 500.0 * Vec3(number(), y, z) : Vec3(number(), y, z));
        points.normal.push_back(normalize_or(normal, {0, 1, 0}));
        points.view.push_back(normalize_or(view, {0, 1, 0}));
        points.roughness.push_back(random.next());
    }
    return points;
}

void append(PointBatch& to, const PointBatch& from, size_t i) {
    to.position.push_back(from.position[i]);
    to.normal.push_back(from.normal[i]);
    to.view.push_back(from.view[i]);
    to.roughness.push_back(from.roughness[i]);
}

ShareBatch shares_of(const PointBatch& points, Precision precision, bool two_sided = false,
                     const std::vector<Vec3>& corners = light) {
    LobeBatch lobes;
    place_lobes(points, lobes);
    ShareBatch shares{std::vector<double>(points.size()), std::vector<double>(points.size()), 0};
    add_polygon(points, lobes, corners, two_sided, Terms::both, precision, {}, shares);
    return shares;
}

TEST_P(Batch, ResultsDoNotDependOnHowPointsAreCutIntoBatches) {
    const PointBatch all = some_points(100);
    for (const Precision precision : precisions) {
        const ShareBatch whole = shares_of(all, precision);
        EXPECT_GT(std::ranges::count_if(whole.specular, [](double s) { return s > 0; }), 20);
        size_t first = 0;
        for (size_t size = 0; size <= 17; ++size) {
            first = (first + 7) % 80;
            PointBatch part;
            for (size_t i = 0; i < size; ++i) append(part, all, first + i);
            const ShareBatch shares = shares_of(part, precision);
            for (size_t i = 0; i < size; ++i) {
                EXPECT_EQ(shares.diffuse[i], whole.diffuse[first + i]) << size;
                EXPECT_EQ(shares.specular[i], whole.specular[first + i]) << size;
            }
        }
        for (size_t i = 0; i < all.size(); ++i) {
            PointBatch one;
            append(one, all, i);
            EXPECT_EQ(shares_of(one, precision).specular[0], whole.specular[i]);
        }
    }
}

TEST_P(Batch, AddsToWhatIsThereAndLeavesTheOtherHalf) {
    const PointBatch points = some_points(21);
    LobeBatch lobes;
    place_lobes(points, lobes);
    for (const Precision precision : precisions) {
        const ShareBatch both = shares_of(points, precision);
        ShareBatch diffuse{std::vector<double>(21, 2.0), {}, 3}, specular{{}, std::vector<double>(21, 2.0), 0};
        add_polygon(points, {}, light, false, Terms::diffuse, precision, {}, diffuse);
        add_polygon(points, lobes, light, false, Terms::specular, precision, {}, specular);
        for (size_t i = 0; i < 21; ++i) {
            EXPECT_EQ(diffuse.diffuse[i], 2 + both.diffuse[i]);
            EXPECT_EQ(specular.specular[i], 2 + both.specular[i]);
        }
        EXPECT_EQ(diffuse.not_finite, 3U);
    }
}

TEST_P(Batch, PointsThatAreNotWantedChangeNothingElse) {
    PointBatch points = some_points(40);
    for (const size_t i : {7U, 8U, 30U}) points.position.x[i] = nan;
    LobeBatch lobes;
    place_lobes(points, lobes);
    std::vector<uint8_t> is_wanted(40, 1);
    for (size_t i = 8; i < 26; ++i) is_wanted[i] = 0;  // whole blocks and parts of some
    for (const Precision precision : precisions) {
        const ShareBatch all = shares_of(points, precision);
        ShareBatch some{std::vector<double>(40), std::vector<double>(40), 0};
        add_polygon(points, lobes, light, false, Terms::both, precision, is_wanted, some);
        for (size_t i = 0; i < 40; ++i) {
            EXPECT_EQ(some.diffuse[i], is_wanted[i] ? all.diffuse[i] : 0);
            EXPECT_EQ(some.specular[i], is_wanted[i] ? all.specular[i] : 0);
        }
        EXPECT_EQ(all.not_finite, 3U);
        EXPECT_EQ(some.not_finite, 2U);
    }
}

TEST_P(Batch, WhatIsNotFiniteGivesNothingAndIsCounted) {
    const PointBatch sound = some_points(19);
    for (const Precision precision : precisions) {
        const ShareBatch expected = shares_of(sound, precision, true);
        for (size_t at = 0; at < 19; at += 6)
            for (const double bad : {nan, inf, -inf})
                for (size_t field = 0; field < 10; ++field) {
                    PointBatch points = sound;
                    const std::array<std::vector<double>*, 10> fields = {
                        &points.position.x, &points.position.y, &points.position.z, &points.normal.x,
                        &points.normal.y,   &points.normal.z,   &points.view.x,     &points.view.y,
                        &points.view.z,     &points.roughness};
                    (*fields[field])[at] = bad;
                    LobeBatch lobes;
                    place_lobes(points, lobes);
                    EXPECT_EQ(lobes.albedo[at], 0);
                    EXPECT_EQ(lobes.share_above[at], 1);
                    EXPECT_GT(lobes.xx[at] * lobes.zz[at] - lobes.xz[at] * lobes.zx[at], 0);
                    EXPECT_TRUE(is_finite(lobes.tangent[at]));
                    const ShareBatch shares = shares_of(points, precision, true);
                    EXPECT_EQ(shares.not_finite, 1U) << field << ' ' << bad;
                    for (size_t i = 0; i < 19; ++i) {
                        EXPECT_EQ(shares.diffuse[i], i == at ? 0 : expected.diffuse[i]) << field << ' ' << bad;
                        EXPECT_EQ(shares.specular[i], i == at ? 0 : expected.specular[i]) << field << ' ' << bad;
                    }
                }
        for (const double bad : {nan, inf, -inf})
            for (int k = 0; k < 12; ++k) {
                std::vector<Vec3> corners = light;
                corners[static_cast<size_t>(k / 3)][k % 3] = bad;
                const ShareBatch shares = shares_of(sound, precision, true, corners);
                EXPECT_EQ(shares.not_finite, 19U);
                EXPECT_EQ(shares.diffuse, std::vector<double>(19));
                EXPECT_EQ(shares.specular, std::vector<double>(19));
            }
    }
}

TEST_P(Batch, HugeAndMinuteNumbersStayFinite) {
    for (const Precision precision : precisions)
        for (const double place : {0.0, 1e-320, 1e-200, 1e-20, 1e20, 1e200, 1.7e308})
            for (const double size : {0.0, 1e-320, 1e-200, 1e-20, 1e20, 1e200, 1.7e308}) {
                PointBatch points = some_points(9);
                for (size_t i = 0; i < 9; ++i) points.position.x[i] = place, points.normal.y[i] *= i % 2 ? 1 : 0;
                std::vector<Vec3> corners = light;
                for (Vec3& corner : corners) corner *= size / 2;
                const ShareBatch shares = shares_of(points, precision, true, corners);
                for (size_t i = 0; i < 9; ++i) {
                    EXPECT_TRUE(shares.diffuse[i] >= 0 && shares.diffuse[i] <= 1) << place << ' ' << size;
                    EXPECT_TRUE(shares.specular[i] >= 0 && shares.specular[i] <= 1) << place << ' ' << size;
                }
            }
    PointBatch zero = some_points(3);
    zero.normal.x[1] = zero.normal.y[1] = zero.normal.z[1] = 0;
    zero.view.x[2] = zero.view.y[2] = zero.view.z[2] = 0;
    const ShareBatch shares = shares_of(zero, Precision::full);
    for (size_t i = 0; i < 3; ++i) EXPECT_TRUE(shares.specular[i] >= 0 && shares.specular[i] <= 1);
}

TEST_P(Batch, OneSideEmitsOrBoth) {
    const PointBatch points = some_points(300);
    const std::vector<Vec3> turned(light.rbegin(), light.rend());
    for (const Precision precision : precisions) {
        const ShareBatch both = shares_of(points, precision, true), front = shares_of(points, precision),
                         back = shares_of(points, precision, false, turned);
        int lit = 0;
        for (size_t i = 0; i < 300; ++i) {
            lit += both.specular[i] > 0 && back.specular[i] > 0;
            EXPECT_TRUE(front.diffuse[i] == 0 || back.diffuse[i] == 0);
            EXPECT_TRUE(front.specular[i] == 0 || back.specular[i] == 0);
            EXPECT_NEAR(front.diffuse[i] + back.diffuse[i], both.diffuse[i], 4e-7);
            EXPECT_NEAR(front.specular[i] + back.specular[i], both.specular[i], 4e-7);
        }
        EXPECT_GT(lit, 5);
    }
}

TEST_P(Batch, LightsWithoutAreaAddNothing) {
    const PointBatch points = some_points(9);
    for (const std::vector<Vec3>& corners :
         {std::vector<Vec3>{}, {light[0]}, {light[0], light[1]}, {light[0], light[0], light[0]}}) {
        const ShareBatch shares = shares_of(points, Precision::mixed, true, corners);
        for (size_t i = 0; i < 9; ++i) EXPECT_LT(shares.diffuse[i] + shares.specular[i], 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, Batch, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return set.param; });

TEST(BatchInstructionSets, AreNamedAndUnknownOnesRefused) {
    EXPECT_FALSE(instruction_sets().empty());
    EXPECT_THROW(use_instruction_set("abacus"), Error);
    const auto before = instruction_sets();
    use_instruction_set(before.back());
    EXPECT_EQ(instruction_sets(), before);  // a choice hides none
    use_instruction_set("");
}

}  // namespace
}  // namespace surimi
