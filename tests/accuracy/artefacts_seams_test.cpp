// SPDX-License-Identifier: Apache-2.0
// One plane under a soft shadow, whole and cut: what a shader reads on both sides of the cut, and what stitching it
// must leave alone.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/seams.h"
#include "tests/support/map_judge.h"
#include "tests/support/seam_survey.h"

namespace surimi {
namespace {

using test::Cut;
using test::CutPlane;

BakeSettings settings_of(Cut cut) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = cut == Cut::pages ? 64 : test::cut_plane_map;
    settings.unwrap.uv = cut == Cut::pages ? UvSource::unwrap : UvSource::existing;
    settings.unwrap.atlases = cut == Cut::pages ? 2 : 1;
    return settings;
}

/// The bake with every measured texel as its irradiance has it.
Bake as_measured(Bake baked) {
    for (BakedPage& page : baked.pages)
        for (size_t i = 0; i < page.state[0].pixels.size(); ++i) {
            const IrradianceEstimate& light = page.irradiance[0].pixels[i];
            if (page.state[0].pixels[i] == TexelState::covered)
                page.map.visibility.pixels[i].x = light.shadowed / light.unshadowed;
        }
    return baked;
}

void expect_no_seam(Cut cut) {
    const CutPlane stage = test::cut_plane(cut);
    const Bake baked = bake(stage.scene, settings_of(cut), {});
    if (cut == Cut::pages) {
        ASSERT_EQ(baked.atlas.pages, 2);
        ASSERT_NE(baked.atlas.surfaces[stage.surfaces[0]].page, baked.atlas.surfaces[stage.surfaces[1]].page);
    }
    const std::vector<double> jumps = test::joint_jumps(stage, baked, 1000);
    ASSERT_EQ(jumps.size(), 1000u);
    EXPECT_LE(*std::max_element(jumps.begin(), jumps.end()), 1.0 / 255);

    const auto at_joint = test::texels_at_joint(stage, baked);
    EXPECT_GT(at_joint.size(), 60u);
    EXPECT_EQ(test::changed_texels(baked, at_joint), 0u);

    // No texel is moved by more than the step that is removed.
    const std::vector<double> steps = test::joint_jumps(stage, as_measured(baked), 1000);
    const double largest_step = *std::max_element(steps.begin(), steps.end());
    EXPECT_GT(largest_step, 0.02);  // or there was nothing to remove
    const double error = GatherSettings{}.error;
    const test::Misses texels = test::MapJudge(stage, baked).compare_texels(error);
    EXPECT_GT(texels.checked, static_cast<size_t>(test::cases(1000)));
    EXPECT_LE(texels.wrong, at_joint.size() + texels.checked / 1000) << texels.text();
    EXPECT_LE(texels.largest, largest_step + error) << texels.text();
}

TEST(Seams, OneQuadHasNothingToStitch) {
    const CutPlane stage = test::cut_plane(Cut::nowhere);
    const Bake baked = bake(stage.scene, settings_of(Cut::nowhere), {});
    EXPECT_EQ(test::changed_texels(baked, {}), 0u);
    size_t penumbra = 0;  // that there is something to see at all
    for (const Vec3f& v : baked.pages[0].map.visibility.pixels) penumbra += v.x > 0.1f && v.x < 0.9f;
    EXPECT_GT(penumbra, 200u);
}

TEST(Seams, TwoChartsOfOnePlaneMeetWithoutAStep) {
    expect_no_seam(Cut::charts);
}

TEST(Seams, TwoObjectsInOnePlaneMeetWithoutAStep) {
    expect_no_seam(Cut::surfaces);
}

TEST(Seams, TwoAtlasesMeetWithoutAStep) {
    expect_no_seam(Cut::pages);
}

TEST(SeamSurvey, FindsTheStepsOfAPlaneInTwoCharts) {
    const CutPlane stage = test::cut_plane(Cut::charts);
    const Bake baked = as_measured(bake(stage.scene, settings_of(Cut::charts), {}));
    const auto edges = test::find_seam_edges(stage.scene, baked.atlas);
    ASSERT_EQ(edges.size(), 1u);  // box edges and borders are none
    const auto found = test::seam_jumps(baked, edges, 0);
    const std::vector<double> expected = test::joint_jumps(stage, baked, 1000);
    EXPECT_GT(found.places.size(), 100u);
    EXPECT_NEAR(found.largest(), *std::max_element(expected.begin(), expected.end()), 0.01);
    const Scene box = test::box_with_hard_edges().scene;
    EXPECT_TRUE(test::find_seam_edges(box, unwrap(box, settings_of(Cut::pages).unwrap, {})).empty());
}

TEST(Seams, HardEdgesAreLeftAloneBitForBit) {
    const test::ArtefactScene stage = test::box_with_hard_edges();
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = 64;
    const Bake baked = bake(stage.scene, settings, {});
    const test::MapJudge judge(stage, baked);
    EXPECT_GT(judge.count(stage.surfaces[0], TexelState::covered), 300u);
    EXPECT_EQ(test::changed_texels(baked, {}), 0u);
}

}  // namespace
}  // namespace surimi
