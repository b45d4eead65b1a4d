// SPDX-License-Identifier: Apache-2.0
// Coarse meshes of round things: the shadow terminator is that of the round thing, and lifting points towards it leaks
// through nothing.
#include <gtest/gtest.h>

#include "baker/texel/texel_surface.h"
#include "tests/scenes/smooth.h"
#include "tests/support/map_judge.h"

namespace surimi {
namespace {

using test::ArtefactScene;
using test::MapJudge;
using test::Misses;
using test::of_size;

void expect_lit(const ArtefactScene& stage) {
    const BakeSettings settings = of_size(96);
    const Bake baked = bake(stage.scene, settings, {});
    const MapJudge judge(stage, baked);
    const Misses misses = judge.compare_with(stage.surfaces[0], 1, settings.gather.error);
    EXPECT_GT(misses.checked, 700u);
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
}

TEST(Terminator, CylinderOfEightSidesIsLitAsTheRoundOne_M3) {
    expect_lit(test::smooth_cylinder(8));
}

TEST(Terminator, CylinderOfSixteenSidesIsLitAsTheRoundOne_M3) {
    expect_lit(test::smooth_cylinder(16));
}

TEST(Terminator, CylinderOfSixtyFourSidesIsLitAsTheRoundOne_M3) {
    expect_lit(test::smooth_cylinder(64));
}

TEST(Terminator, CoarseBallIsLitAsTheRoundOne_M3) {
    expect_lit(test::smooth_ball(1));
}

TEST(Terminator, PipeThroughAWallIsDarkBehindIt_M3) {
    const ArtefactScene stage = test::pipe_through_a_wall();
    const Bake baked = bake(stage.scene, of_size(192), {});
    const Texels texels = find_texels(stage.scene, baked.atlas);
    size_t dark = 0, lit = 0;
    for (const Texel& texel : texels.texels) {
        if (baked.atlas.charts[texel.chart].surface != stage.surfaces[0]) continue;
        if (baked.pages[0].state[0].pixels[texel.index] != TexelState::covered) continue;
        double nearest = INFINITY;
        TexelSurface(stage.scene, baked.atlas, texels, texel).for_each_corner([&](const SurfacePoint& corner) {
            nearest = std::min(nearest, corner.position.x);
        });
        const float v = baked.pages[0].map.visibility.pixels[texel.index].x;
        if (nearest >= stage.solids[0].high.x) {
            EXPECT_EQ(v, 0.f) << "at x = " << nearest;
            ++dark;
        }
        lit += v > 0.99f;
    }
    EXPECT_GT(dark, 200u);
    EXPECT_GT(lit, 100u);
}

TEST(Terminator, CylinderAgainstAWallIsDarkBehindIt_M3) {
    const ArtefactScene stage = test::cylinder_against_a_wall();
    const Bake baked = bake(stage.scene, of_size(192), {});
    const Misses misses = MapJudge(stage, baked).compare_with(stage.surfaces[0], 0, 0);
    EXPECT_GT(misses.checked, 300u);  // what touches the wall is inside
    EXPECT_EQ(misses.wrong, 0u) << misses.text();
}

}  // namespace
}  // namespace surimi
