// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <set>
#include <stdexcept>

#include "runtime/base/error.h"
#include "runtime/base/math.h"
#include "runtime/base/parallel.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

TEST(Sobol, EveryPairOfTheFirstTwoDimensionsIsANet) {
    // 256 points: exactly one in each elementary interval of area 1/256, for all nine shapes; scrambling keeps it.
    for (const bool is_scrambled : {false, true}) {
        for (int shape = 0; shape <= 8; ++shape) {
            std::set<std::pair<int, int>> cells;
            for (uint32_t i = 0; i < 256; ++i) {
                const auto raw = sobol::point(i);
                const auto r = is_scrambled ? scrambled(raw, scrambling(77))
                                            : std::array<double, 4>{raw[0] * 0x1p-32, raw[1] * 0x1p-32, 0, 0};
                cells.insert({static_cast<int>(r[0] * (1 << shape)), static_cast<int>(r[1] * (1 << (8 - shape)))});
            }
            EXPECT_EQ(cells.size(), 256u) << shape << is_scrambled;
        }
    }
}

TEST(Sobol, EachDimensionIsStratified) {
    for (size_t d = 0; d < 4; ++d) {
        std::set<int> cells;
        for (uint32_t i = 0; i < 1024; ++i)
            cells.insert(static_cast<int>(scrambled(sobol::point(i), scrambling(3))[d] * 1024));
        EXPECT_EQ(cells.size(), 1024u) << d;
    }
}

TEST(Sobol, KeysGiveDifferentPoints) {
    std::set<double> values;
    for (uint64_t key = 0; key < 1000; ++key) values.insert(scrambled(sobol::point(0), scrambling(key))[2]);
    EXPECT_GT(values.size(), 990u);
}

TEST(NormalizeOr, SurvivesExtremeLengths) {
    for (const double scale : {1e-300, 1.0, 1e300})
        EXPECT_NEAR(glm::length(normalize_or(scale * Vec3(1, 2, -2), {0, 0, 1}) - Vec3(1, 2, -2) / 3.0), 0, 1e-15)
            << scale;
    EXPECT_EQ(normalize_or(Vec3(0), {0, 0, 1}), Vec3(0, 0, 1));
    EXPECT_EQ(normalize_or(Vec3(NAN, 0, 0), {0, 0, 1}), Vec3(0, 0, 1));
    EXPECT_EQ(normalize_or(Vec3(INFINITY, 0, 0), {0, 0, 1}), Vec3(0, 0, 1));
}

TEST(Parallel, VisitsEveryItemOnce) {
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        std::vector<std::atomic<int>> visits(1001);
        parallel_for(visits.size(), 7, [&](size_t i) { ++visits[i]; });
        for (const auto& v : visits) EXPECT_EQ(v, 1);
    }
    set_thread_count(0);
    parallel_for(0, 7, [](size_t) { FAIL(); });
}

TEST(Parallel, PassesExceptionsOn) {
    EXPECT_THROW(parallel_for(100, 1,
                              [](size_t i) {
                                  if (i == 50) throw std::runtime_error("x");
                              }),
                 std::runtime_error);
}

TEST(Parallel, StageReportsItsEndAndStopsWhenCancelled) {
    std::atomic<double> last{-1};
    Progress progress;
    progress.report = [&](std::string_view, double f) { last = std::max(last.load(), f); };
    parallel_stage("x", 10, 3, progress, [](size_t, size_t) {});
    EXPECT_EQ(last, 1);
    progress.is_cancelled = [] { return true; };
    try {
        parallel_stage("x", 10, 3, progress, [](size_t, size_t) {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::interrupted);
    }
}

}  // namespace
}  // namespace surimi
