// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/confidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/base/random.h"

namespace surimi {
namespace {

TEST(Confidence, LargestShareIsTheBoundOfClopperAndPearson) {
    EXPECT_EQ(largest_share(0, 0), 1);
    EXPECT_EQ(largest_share(5, 5), 1);
    EXPECT_NEAR(largest_share(0, 1), 0.95, 1e-12);
    EXPECT_NEAR(largest_share(0, 1000), 1 - std::pow(0.05, 1e-3), 1e-12);  // the rule of three
    EXPECT_NEAR(largest_share(1, 10), 0.394163, 1e-6);                     // their tables
    EXPECT_NEAR(largest_share(5, 10), 0.777559, 1e-6);
    EXPECT_NEAR(largest_share(0, 1000000), 2.99573e-6, 1e-10);
    EXPECT_GT(largest_share(50000, 100000), 0.5);  // terms below the smallest double
    EXPECT_LT(largest_share(50000, 100000), 0.503);
}

TEST(Confidence, IntervalOfTheRootMeanCoversTheTruth) {
    // Squares of normal errors of RMS 0.01, 200 at a time. 400 trials at 95 % miss 20 times, and with the bootstrap's
    // optimism on such samples about 25; more than 45 is 4 standard deviations off.
    int misses = 0;
    for (uint64_t trial = 0; trial < 400; ++trial) {
        std::vector<double> squares;
        for (uint64_t i = 0; i < 200; ++i) {
            const double r = std::sqrt(-2 * std::log(1 - unit_double(hash(hash(trial, i), 0))));
            const double error = 0.01 * r * std::cos(6.283185307179586 * unit_double(hash(hash(trial, i), 1)));
            squares.push_back(error * error);
        }
        const Interval interval = root_mean_interval(squares, trial);
        EXPECT_LT(interval.low, interval.high);
        if (interval.low > 0.01 || interval.high < 0.01) ++misses;
    }
    EXPECT_LE(misses, 45);
    EXPECT_GE(misses, 5);
}

TEST(Confidence, IntervalOfNothingIsNothing) {
    EXPECT_EQ(root_mean_interval({}, 1).high, 0);
    const std::vector<double> below(10, -1e-6);  // noise taken off may leave less than nothing
    EXPECT_EQ(root_mean_interval(below, 1).high, 0);
}

}  // namespace
}  // namespace surimi
