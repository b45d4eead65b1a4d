// SPDX-License-Identifier: Apache-2.0
// The same map in every size and place, and of nodes that mirror or flatten.
#include <gtest/gtest.h>

#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "tests/scenes/scales.h"
#include "tests/support/map_judge.h"
#include "tests/unit/glb_builder.h"

namespace surimi {
namespace {

using test::ArtefactScene;

BakeSettings own_charts() {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = test::room_map;
    settings.unwrap.uv = UvSource::existing;
    return settings;
}

/// Every measured texel is within twice the error of its value in the other bake: either may be off by one.
void expect_same_map(const Bake& bake, const Bake& other) {
    const auto& pixels = bake.pages[0].map.visibility.pixels;
    test::Misses misses;
    size_t states = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        states += bake.pages[0].state[0].pixels[i] != other.pages[0].state[0].pixels[i];
        if (bake.pages[0].state[0].pixels[i] != TexelState::covered) continue;
        misses.add(static_cast<double>(other.pages[0].map.visibility.pixels[i].x), static_cast<double>(pixels[i].x),
                   2 * GatherSettings{}.error, "texel " + std::to_string(i));
    }
    EXPECT_GT(misses.checked, 10000u);
    EXPECT_LE(misses.wrong, misses.checked / 1000) << misses.text();
    EXPECT_LE(states, misses.checked / 1000);  // whether a texel on a border counts is a matter of rounding
}

void expect_same_when_moved(double factor, const Vec3& offset) {
    const ArtefactScene stage = test::furnished_room();
    const Scene elsewhere = test::moved(stage.scene, {0, 1, 0}, 0, factor, offset);
    expect_same_map(bake(stage.scene, own_charts(), {}), bake(elsewhere, own_charts(), {}));
}

TEST(Scale, OfAThousandthGivesTheSameMap_M3) {
    expect_same_when_moved(1e-3, Vec3(0));
}

TEST(Scale, OfTenThousandGivesTheSameMap_M3) {
    expect_same_when_moved(1e4, Vec3(0));
}

TEST(Place, AHundredKilometresAwayGivesTheSameMap_M3) {
    expect_same_when_moved(1, {1e5, -1e5, 1e5});
}

Bake bake_file(const std::filesystem::path& file, Scene& scene) {
    scene = read_gltf(file);
    find_monitors(scene, {});
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = 64;
    return bake(scene, settings, {});
}

/// The floor and the two blocks that stand above it.
ArtefactScene stage_of(const Scene& scene) {
    ArtefactScene stage;
    stage.scene = scene;
    stage.surfaces = {0};
    for (const uint32_t block : {2u, 3u}) {
        stage.surfaces.push_back(block);
        stage.solids.push_back(test::solid_of(scene, block));
    }
    return stage;
}

TEST(MirroredNode, HasTheMirroredMap_M3) {
    const auto file = test::test_folder() / "mirrored.glb";
    test::write_mirrored_blocks(file);
    Scene scene;
    const Bake baked = bake_file(file, scene);
    ASSERT_EQ(scene.surfaces.size(), 4u);
    const ArtefactScene stage = stage_of(scene);
    EXPECT_LT(stage.solids[1].high.x, 0);
    const test::MapJudge judge(stage, baked);
    const test::Misses misses = judge.compare_texels(GatherSettings{}.error);
    EXPECT_GT(misses.checked, static_cast<size_t>(test::cases(700)));
    EXPECT_LE(misses.wrong, misses.checked / 1000) << misses.text();
    // The monitor is as far from one as from the other, so it lights as many texels of both, but for borders.
    const double one = static_cast<double>(judge.count(2, TexelState::covered));
    EXPECT_GT(one, 80);
    EXPECT_NEAR(static_cast<double>(judge.count(3, TexelState::covered)), one, 0.1 * one);
}

TEST(ZeroScaleNode, IsAsIfItWereNotThere) {
    const auto folder = test::test_folder();
    test::write_mirrored_blocks(folder / "plain.glb");
    test::write_blocks_and_nothing(folder / "nothing.glb");
    Scene plain, nothing;
    const Bake one = bake_file(folder / "plain.glb", plain), other = bake_file(folder / "nothing.glb", nothing);
    EXPECT_EQ(triangle_count(plain), triangle_count(nothing));
    EXPECT_EQ(one.pages[0].map.visibility.pixels, other.pages[0].map.visibility.pixels);
}

TEST(FlatNode, InTheFloorsPlaneHidesNothing_M3) {
    const auto file = test::test_folder() / "flat.glb";
    test::write_blocks_and_a_flat_one(file);
    Scene scene;
    const Bake baked = bake_file(file, scene);
    ASSERT_EQ(scene.surfaces.size(), 5u);
    for (const Vec3f& v : baked.pages[0].map.visibility.pixels)
        EXPECT_TRUE(v.x >= 0 && v.x <= 1 && v.y == 1 && v.z == 1);
    ArtefactScene stage = stage_of(scene);
    stage.equal = scene;
    stage.equal->surfaces.pop_back();
    const test::Misses misses = test::MapJudge(stage, baked).compare_texels(GatherSettings{}.error);
    EXPECT_GT(misses.checked, static_cast<size_t>(test::cases(700)));
    EXPECT_LE(misses.wrong, misses.checked / 1000) << misses.text();
}

}  // namespace
}  // namespace surimi
