// SPDX-License-Identifier: Apache-2.0
// Scanlines keep the error that was asked for, point by point.
#include <gtest/gtest.h>

#include "tests/support/occlusion_scenes.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

using test::Deviations;
using test::VisibilityJudge;

class VisibilityScanline : public testing::TestWithParam<double> {};

/// The promise for points (research/sampling.md 4.4).
void expect_promise(const Deviations& found, double error) {
    EXPECT_LE(found.rmse(), error / 4);
    EXPECT_LE(found.quantile(0.999), error);
    EXPECT_LE(found.largest(), 5 * error) << found.worst;
}

Deviations against_subtraction(const VisibilityJudge& judge, int points, double error) {
    Deviations found;
    Choice choice{Random{11}};
    for (size_t monitor = 0; monitor < judge.scene().monitors.size(); ++monitor)
        for (int i = 0; i < points; ++i) {
            const SurfacePoint point = test::random_point(judge.scene(), choice, i % 2);
            const test::SubtractedIrradiance truth = judge.truth(point, monitor);
            if (truth.unshadowed < 1e-6) continue;
            found.add(judge.scanline(point, error, monitor), truth.visibility(), point);
        }
    return found;
}

TEST_P(VisibilityScanline, KeepsTheErrorInTheStudysRoom_M54) {
    const VisibilityJudge judge(test::room_with(test::Contents::low));
    const Deviations found = against_subtraction(judge, test::cases(3000), GetParam());
    EXPECT_GT(found.penumbra, test::cases(1000));
    expect_promise(found, GetParam());
}

TEST_P(VisibilityScanline, KeepsTheErrorWhereGeometryIsBroken_M54) {
    const VisibilityJudge judge(test::nasty_room());
    const Deviations found = against_subtraction(judge, test::cases(3000), GetParam());
    EXPECT_GT(found.penumbra, test::cases(1000));
    expect_promise(found, GetParam());
}

TEST_P(VisibilityScanline, KeepsTheErrorAmongAHundredThousandTriangles_M55) {
    static const VisibilityJudge judge(test::room_with(test::Contents::mid));
    Deviations found;
    Choice choice{Random{12}};
    for (size_t monitor = 0; monitor < 3; ++monitor)
        for (int i = 0; i < test::cases(300);
             ++i) {  // of the plain surfaces: the truth is splitting, which is judged elsewhere
            const SurfacePoint point = test::random_point(judge.scene(), choice, 0);
            if (i % 3 != 0 && !judge.scene().surfaces[point.triangle.surface].name.starts_with("Plain_")) continue;
            found.add(judge.scanline(point, GetParam(), monitor), judge.split(point, monitor), point);
        }
    EXPECT_GT(found.penumbra, test::cases(100));
    expect_promise(found, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Errors, VisibilityScanline, testing::Values(0.02, 0.004, 0.001),
                         [](const testing::TestParamInfo<double>& error) {
                             return "Error" + std::to_string(static_cast<int>(1e4 * error.param + 0.5));
                         });

}  // namespace
}  // namespace surimi
