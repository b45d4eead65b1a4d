// SPDX-License-Identifier: Apache-2.0
// Maps fitted to bilinear reads against exact points, beside maps of averages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/scenes/seams.h"
#include "tests/scenes/walls.h"
#include "tests/support/map_judge.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

using test::ArtefactScene;
using test::Cut;

struct ReadErrors {
    size_t points = 0;
    double rms = 0, mean = 0;
};

/// Of what a shader reads at random places of the judged surfaces that can be seen.
ReadErrors read_errors(const ArtefactScene& stage, const Bake& baked) {
    const test::MapJudge judge(stage, baked);
    Choice choice{{11}};
    ReadErrors errors;
    double squares = 0;
    while (errors.points < static_cast<size_t>(test::cases(4000))) {
        const SurfacePoint point = test::random_point(stage.scene, choice, 0);
        if (std::ranges::find(stage.surfaces, point.triangle.surface) == stage.surfaces.end()) continue;
        const auto truth = judge.truth(point);
        if (!truth) continue;
        const double off = std::abs(test::read_map(baked, point.triangle, point.barycentric) - *truth);
        errors.mean += off;
        squares += off * off;
        ++errors.points;
    }
    errors.mean /= static_cast<double>(errors.points);
    errors.rms = std::sqrt(squares / static_cast<double>(errors.points));
    return errors;
}

/// By at least these factors the fit lessens both errors.
void expect_less(const ArtefactScene& stage, BakeSettings settings, double rms_factor, double mean_factor) {
    const ReadErrors averages = read_errors(stage, bake(stage.scene, settings, {}));
    settings.post.fit = Fit::bilinear;
    const Bake fitted = bake(stage.scene, settings, {});
    const ReadErrors fit = read_errors(stage, fitted);
    EXPECT_LT(fit.rms, rms_factor * averages.rms);
    EXPECT_LT(fit.mean, mean_factor * averages.mean);
    EXPECT_GT(averages.mean, 0.0005) << "nothing to gain";
    EXPECT_LT(fitted.evidence[0].fit.rms_after, 0.95 * fitted.evidence[0].fit.rms_before);
    testing::Test::RecordProperty("averages", std::to_string(averages.rms) + " " + std::to_string(averages.mean));
    testing::Test::RecordProperty("fitted", std::to_string(fit.rms) + " " + std::to_string(fit.mean));
}

BakeSettings settings_of(Cut cut) {
    BakeSettings settings = test::of_size(cut == Cut::pages ? 64 : test::cut_plane_map);
    settings.unwrap.uv = cut == Cut::pages ? UvSource::unwrap : UvSource::existing;
    settings.unwrap.atlases = cut == Cut::pages ? 2 : 1;
    return settings;
}

TEST(BilinearFit, ReadsOfASoftShadowComeCloserToTheTruth_M67) {
    expect_less(test::cut_plane(Cut::nowhere), settings_of(Cut::nowhere), 0.75, 0.75);
}

TEST(BilinearFit, ReadsBesideASunkBoxComeCloserToTheTruth_M67) {
    expect_less(test::box_sunk_into_a_floor(), test::of_size(64), 0.99, 0.95);
}

TEST(BilinearFit, SeamsStillAgreeOnAllCuts_M67) {
    for (const Cut cut : {Cut::charts, Cut::surfaces, Cut::pages}) {
        SCOPED_TRACE(static_cast<int>(cut));
        const test::CutPlane stage = test::cut_plane(cut);
        BakeSettings settings = settings_of(cut);
        settings.post.fit = Fit::bilinear;
        const Bake fitted = bake(stage.scene, settings, {});
        ASSERT_EQ(fitted.atlas.pages, cut == Cut::pages ? 2 : 1);
        const std::vector<double> jumps = test::joint_jumps(stage, fitted, 1000);
        ASSERT_EQ(jumps.size(), 1000u);
        EXPECT_LE(*std::ranges::max_element(jumps), 1.0 / 255);
        EXPECT_GT(fitted.evidence[0].fit.texels, 200u);
        settings.post.stitches_seams = false;
        const auto unstitched = test::joint_jumps(stage, bake(stage.scene, settings, {}), 1000);
        EXPECT_GT(*std::ranges::max_element(unstitched), 1.0 / 255) << "nothing to stitch";
        testing::Test::RecordProperty("unstitched", std::to_string(*std::ranges::max_element(unstitched)));
    }
}

TEST(BilinearFit, WithoutItTexelsHoldAverages_M67) {
    const test::CutPlane stage = test::cut_plane(Cut::nowhere);
    BakeSettings settings = settings_of(Cut::nowhere);
    EXPECT_EQ(test::changed_texels(bake(stage.scene, settings, {}), {}), 0u) << "not the default";
    settings.post.fit = Fit::bilinear;
    const Bake fitted = bake(stage.scene, settings, {});
    EXPECT_GT(test::changed_texels(fitted, {}), 200u);
    for (const Vec3f& value : fitted.pages[0].map.visibility.pixels) EXPECT_TRUE(value.x >= 0 && value.x <= 1);
}

}  // namespace
}  // namespace surimi
