// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/scanline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/batch/batch.h"
#include "tests/support/seen_panel.h"

namespace surimi {
namespace {

using test::SeenPanel;

PointVisibility scanned(const SeenPanel& seen, int lines, double shift = 0.3, int checks = 2) {
    ScanlineWorkspace work;
    return scan(seen.view, seen.segments, {seen.rays, 0, lines, shift, checks, 5}, work);
}

double split_visibility(const SeenPanel& seen) {
    SplitWorkspace work;
    return split(seen.view, seen.segments, seen.rays, 0, work).visibility;
}

TEST(Scanline, NothingInTheWayIsExactlyOne) {
    SeenPanel seen(test::occluded_scene(0, 0, 0));
    Choice choice{Random{1}};
    for (int i = 0; i < 50; ++i) {
        seen.look_from_below(choice, 1);
        const PointVisibility found = scanned(seen, 16);
        EXPECT_TRUE(found.is_consistent);
        EXPECT_EQ(found.visibility, seen.view.open.empty() ? 0 : 1);
        EXPECT_EQ(found.error, 0);
    }
}

TEST(Scanline, EverythingHiddenIsExactlyZero) {
    Scene scene = test::occluded_scene(2, 10, 3);
    test::add_quad(scene, "Lid", {-4, 0.5, 4}, {4, 0.5, 4}, {4, 0.5, -4}, {-4, 0.5, -4});
    SeenPanel seen(std::move(scene));
    Choice choice{Random{2}};
    for (int i = 0; i < 50; ++i) {
        seen.look_from_below(choice, 0);
        const PointVisibility found = scanned(seen, 16);
        EXPECT_TRUE(found.is_consistent);
        EXPECT_EQ(found.visibility, 0);
    }
}

TEST(Scanline, ApproachesSplittingWithThe15thPowerOfTheLines_M54) {
    SeenPanel seen(test::occluded_scene(7, 30, 5));
    const auto rms = [&](int lines) {
        Choice choice{Random{3}};
        double squares = 0;
        for (int i = 0; i < 100; ++i) {
            seen.look_from_below(choice, i % 2);
            const PointVisibility found = scanned(seen, lines, choice.random.next());
            EXPECT_TRUE(found.is_consistent) << i;
            squares += std::pow(found.visibility - split_visibility(seen), 2) / 100;
        }
        return std::sqrt(squares);
    };
    const double at_32 = rms(32), at_512 = rms(512);
    EXPECT_LT(at_32, 0.01);
    EXPECT_LT(at_512, at_32 / std::pow(16, 1.2));
}

TEST(Scanline, ErrorsAreWithinThreeEstimates_M55) {
    int beyond = 0, count = 0;
    double errors = 0, estimates = 0;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        SeenPanel seen(test::occluded_scene(seed, 30, 5));
        Choice choice{Random{seed}};
        for (int i = 0; i < 250; ++i) {
            seen.look_from_below(choice, i % 2);
            const double truth = split_visibility(seen);
            if (truth < 1e-6 || truth > 1 - 1e-6) continue;
            const PointVisibility found = scanned(seen, 64, choice.random.next());
            const double error = std::abs(found.visibility - truth);
            beyond += error > 3 * found.error + 1e-9;
            errors += error * error;
            estimates += found.error * found.error;
            ++count;
        }
    }
    ASSERT_GT(count, 500);
    EXPECT_LE(beyond, count / 100);  // research/sampling.md 2.6: 0.1 to 0.5 %
    EXPECT_GT(estimates, errors) << "not below the truth in the mean";
    EXPECT_LT(estimates, 64 * errors) << "nor eight times above it";
}

TEST(Scanline, RaysThatContradictTheSilhouettesAreNoticed) {
    Scene scene = test::occluded_scene(0, 0, 0);
    test::add_quad(scene, "Half", {0.05, 1.2, 2}, {3, 1.2, 2}, {3, 1.2, -2}, {0.05, 1.2, -2});
    SeenPanel seen(std::move(scene));
    seen.look_from({0, 0.01, 0}, {0, 1, 0});
    ASSERT_GT(seen.segments.count, 0u);
    EXPECT_TRUE(scanned(seen, 64).is_consistent);
    for (size_t i = 0; i < seen.segments.count; ++i) seen.segments.jump[i] = -seen.segments.jump[i];
    EXPECT_FALSE(scanned(seen, 64).is_consistent) << "free and blocked changed places";
    seen.segments.count = 0;
    seen.segments.on_sides.clear();
    EXPECT_FALSE(scanned(seen, 64, 0.3, 32).is_consistent) << "nothing there, say the silhouettes";
}

TEST(Scanline, EveryInstructionSetFindsTheSame) {
    SeenPanel seen(test::occluded_scene(9, 40, 6));
    std::vector<double> first;
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        Choice choice{Random{4}};
        for (size_t i = 0; i < 50; ++i) {
            seen.look_from_below(choice, 0);
            const double visibility = scanned(seen, 64).visibility;
            if (first.size() == i) first.push_back(visibility);
            EXPECT_NEAR(visibility, first[i], 1e-6) << set;  // crossings are kept as float
        }
    }
    use_instruction_set("");
}

}  // namespace
}  // namespace surimi
