// SPDX-License-Identifier: Apache-2.0
// Screens that touch what is around them do not block themselves, and leaves are no inside of anything.
#include <gtest/gtest.h>

#include "tests/scenes/screens.h"
#include "tests/support/map_judge.h"

namespace surimi {
namespace {

using test::ArtefactScene;
using test::MapJudge;
using test::Misses;
using test::of_size;

/// All that is lit is exactly 1, as in an empty convex room.
void expect_open(const ArtefactScene& stage) {
    const Bake baked = bake(stage.scene, of_size(128), {});
    const Misses misses = MapJudge(stage, baked).compare_with(stage.surfaces[0], 1, 0);
    EXPECT_GT(misses.checked, 2000u);
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
}

TEST(GluedScreen, InThePlaneOfItsWallDoesNotBlockItself_M3) {
    expect_open(test::screen_on_a_wall(0));
}

TEST(GluedScreen, ATenthOfAMillimetreBeforeItsWallDoesNotBlockItself_M3) {
    expect_open(test::screen_on_a_wall(1e-4));
}

TEST(GluedScreen, AMillimetreBehindTheFaceOfItsWallDoesNotBlockItself_M3) {
    expect_open(test::screen_on_a_wall(-1e-3));
}

TEST(GluedScreen, BehindAScreenMeshDoesNotBlockItself_M3) {
    expect_open(test::screen_behind(test::Cover::mesh));
}

TEST(GluedScreen, BehindAGlassPlateDoesNotBlockItself_M3) {
    expect_open(test::screen_behind(test::Cover::glass));
}

TEST(StandingScreen, TouchesTheFloorAndLightsItUpToItsEdge_M3) {
    expect_open(test::screen_on_the_floor());
}

TEST(Foliage, LetsLightThroughItsHolesExactly_M3) {
    const ArtefactScene stage = test::card_with_a_hole();
    const BakeSettings settings = of_size(64);
    const Bake baked = bake(stage.scene, settings, {});
    const Misses misses = MapJudge(stage, baked).compare_texels(settings.gather.error);
    EXPECT_GT(misses.checked, static_cast<size_t>(test::cases(500)));
    EXPECT_LE(misses.wrong, misses.checked / 1000) << misses.text();
}

TEST(Foliage, LitFromBehindIsNoInsideOfAnything_M3) {
    const ArtefactScene stage = test::cards_lit_from_behind();
    BakeSettings settings = of_size(96);
    const Bake baked = bake(stage.scene, settings, {});
    const MapJudge judge(stage, baked);
    for (const uint32_t surface : stage.surfaces) EXPECT_EQ(judge.count(surface, TexelState::inside), 0u) << surface;
    ArtefactScene floor = stage;
    floor.surfaces = {stage.surfaces[0]};
    const Misses misses = MapJudge(floor, baked).compare_texels(settings.gather.error);
    EXPECT_GT(misses.checked, static_cast<size_t>(test::cases(500)));
    EXPECT_LE(misses.wrong, misses.checked / 1000) << misses.text();
}

TEST(Foliage, LightOnItsBackCounts_M3) {
    const ArtefactScene stage = test::card_lit_from_behind();
    const Bake baked = bake(stage.scene, of_size(32), {});
    const Misses misses = MapJudge(stage, baked).compare_with(stage.surfaces[0], 1, 0);
    EXPECT_GT(misses.checked, 50u);
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
}

}  // namespace
}  // namespace surimi
