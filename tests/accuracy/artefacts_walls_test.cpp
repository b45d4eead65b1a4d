// SPDX-License-Identifier: Apache-2.0
// Leaks through walls and rims where things stand in one another: the values of what can be seen, texel by texel and
// as a shader reads them.
#include <gtest/gtest.h>

#include "tests/scenes/walls.h"
#include "tests/support/map_judge.h"

namespace surimi {
namespace {

using test::ArtefactScene;
using test::MapJudge;
using test::Misses;
using test::of_size;

/// Texels are within the error of what can be seen of them, one in a thousand excepted, and reads where all around is
/// lit, or all is dark, are exactly that, or within what a `penumbra` between the places looked at may take from a
/// texel.
void expect_no_rims(const ArtefactScene& stage, int least_texels, int least_reads, double penumbra = 0) {
    const double error = GatherSettings{}.error;
    BakeSettings settings = of_size(96);
    settings.gather.error = error / 2;  // rims are judged here, not whether one in a thousand is beyond the error
    const Bake baked = bake(stage.scene, settings, {});
    const MapJudge judge(stage, baked);
    const Misses texels = judge.compare_texels(error);
    EXPECT_GT(texels.checked, static_cast<size_t>(test::cases(least_texels)));
    EXPECT_LE(texels.wrong, texels.checked / 1000) << "texels: " << texels.text();
    const Misses reads = judge.compare_plain_reads(static_cast<size_t>(test::cases(4000)), penumbra);
    EXPECT_GT(reads.checked, static_cast<size_t>(test::cases(least_reads)));
    EXPECT_EQ(reads.wrong, 0u) << "reads: " << reads.text();
}

TEST(ThinWall, TwoRoomsWithFacesOfTheirOwnAreExactlyLitAndDark_M3) {
    const ArtefactScene stage = test::two_rooms();
    const Bake baked = bake(stage.scene, of_size(128), {});
    const MapJudge judge(stage, baked);
    for (const size_t room : {0, 1}) {
        const Misses misses = judge.compare_with(stage.surfaces[room], room == 0 ? 1 : 0, 0);
        EXPECT_GT(misses.checked, 1000u);
        EXPECT_EQ(misses.wrong, 0u) << misses.text();
    }
    const Misses reads = judge.compare_plain_reads(4000);
    EXPECT_GT(reads.checked, 400u);
    EXPECT_EQ(reads.wrong, 0u) << reads.text();
}

TEST(ThinWall, OneFloorUnderItLeaksNoFartherThanItsTexels_M3) {
    expect_no_rims(test::two_rooms_on_one_floor(), 2500, 500);
}

TEST(ClosedRoom, WithoutThicknessIsExactlyDark_M3) {
    const ArtefactScene stage = test::closed_room(0);
    const Bake baked = bake(stage.scene, of_size(128), {});
    const MapJudge judge(stage, baked);
    const Misses misses = judge.compare_with(stage.surfaces[0], 0, 0);
    EXPECT_GT(misses.checked, 1000u);
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
    EXPECT_EQ(judge.count(stage.surfaces[0], TexelState::inside), 0u);  // a room's inside is where people are
}

TEST(ClosedRoom, WithThickWallsIsExactlyDark_M3) {
    for (const double thickness : {0.001, 0.01, 0.2}) {
        SCOPED_TRACE(thickness);
        const ArtefactScene stage = test::closed_room(thickness);
        const Bake baked = bake(stage.scene, of_size(128), {});
        const MapJudge judge(stage, baked);
        const Misses misses = judge.compare_with(stage.surfaces[0], 0, 0);
        EXPECT_GT(misses.checked, 800u);
        EXPECT_EQ(misses.wrong, 0u) << misses.text();
        EXPECT_EQ(judge.count(stage.surfaces[0], TexelState::inside), 0u);
        const Misses reads = judge.compare_plain_reads(4000);
        EXPECT_GT(reads.checked, 400u);
        EXPECT_EQ(reads.wrong, 0u) << reads.text();
    }
}

TEST(SunkBox, HasNoRimsAndTheFloorBesideItNeither_M3) {
    expect_no_rims(test::box_sunk_into_a_floor(), 2500, 800);
}

TEST(SunkBox, TexelsUnderItAreInsideAndNotMeasured) {
    const ArtefactScene stage = test::box_sunk_into_a_floor();
    const Bake baked = bake(stage.scene, of_size(128), {});
    const MapJudge judge(stage, baked);
    EXPECT_GT(judge.count(stage.surfaces[0], TexelState::inside), 100u);  // 0.72 m^2 of floor
    EXPECT_GT(judge.count(stage.surfaces[1], TexelState::inside), 20u);   // and of the sides what is next to it
}

TEST(StandingBox, WithItsBottomInTheFloorsPlaneHasNoRims_M3) {
    expect_no_rims(test::box_upon_a_floor(), 2500, 800);
}

TEST(InterpenetratingBoxes, HaveNoRims_M3) {
    expect_no_rims(test::boxes_that_interpenetrate(), 1200, 300);
}

TEST(BoxesInARow, HaveNoLinesAtTheirJoints_M3) {
    const ArtefactScene stage = test::boxes_in_a_row();
    const Bake baked = bake(stage.scene, of_size(128), {});
    const MapJudge judge(stage, baked);
    const Misses reads = judge.compare_plain_reads(6000);
    EXPECT_GT(reads.checked, 1000u);
    EXPECT_EQ(reads.wrong, 0u) << reads.text();
}

TEST(RugInThePlaneOfAFloor, BothAreExactlyLit_M3) {
    const ArtefactScene stage = test::rug_in_the_plane_of_a_floor();
    const Bake baked = bake(stage.scene, of_size(128), {});
    const MapJudge judge(stage, baked);
    for (const uint32_t surface : stage.surfaces) {
        const Misses misses = judge.compare_with(surface, 1, 0);
        EXPECT_GT(misses.checked, 200u);
        EXPECT_EQ(misses.wrong, 0u) << misses.text();
    }
}

TEST(Poster, AMillimetreBehindAWallDoesNotShine_M3) {
    const ArtefactScene stage = test::poster_behind_a_wall();
    const Bake baked = bake(stage.scene, of_size(128), {});
    const MapJudge judge(stage, baked);
    const Misses wall = judge.compare_with(stage.surfaces[0], 1, 0);
    EXPECT_GT(wall.checked, 1000u);
    EXPECT_EQ(wall.wrong, 0u) << wall.text();
    const Misses poster = judge.compare_with(stage.surfaces[1], 0, 0);
    EXPECT_EQ(poster.wrong, 0u) << poster.text();
    EXPECT_GT(poster.checked + judge.count(stage.surfaces[1], TexelState::inside), 200u);
}

TEST(Poster, AMillimetreBeforeAWallHasNoRim_M3) {
    // Its own penumbra: light at a slope of up to 1/2 over 1 mm, in a texel of 31 mm.
    expect_no_rims(test::poster_before_a_wall(), 2000, 500, 0.5 * 0.001 / 0.031);
}

}  // namespace
}  // namespace surimi
