// SPDX-License-Identifier: Apache-2.0
// Answers that are known without a reference: nothing in the way, everything in the way.
#include <gtest/gtest.h>

#include "baker/bake.h"
#include "runtime/base/error.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

BakeSettings small(int size) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = size;
    return settings;
}

TEST(Furnace, WithNothingInTheWayEveryLitTexelIsExactlyOne_M3) {
    Scene scene;
    test::add_box(scene, "Room", Vec3(0), {4, 3, 5}, true);  // convex: it never blocks its own view
    test::add_monitor(scene, "Monitor_R", 0, {0, 0, -2.49}, {0.8, 0, 0}, {0, 0.45, 0});
    const Bake result = bake(scene, small(128), {});
    size_t covered = 0;
    for (size_t i = 0; i < result.pages[0].map.visibility.pixels.size(); ++i) {
        EXPECT_EQ(result.pages[0].map.visibility.pixels[i], Vec3f(1)) << i;  // filled texels and unused channels too
        covered += result.pages[0].state[0].pixels[i] == TexelState::covered;
    }
    EXPECT_GT(covered, 1000u);
}

TEST(ClosedBox, ARoomWithinARoomIsExactlyDarkOutside_M3) {
    Scene scene;
    const uint32_t outer = test::add_box(scene, "Outer", Vec3(0), Vec3(6), true);
    test::add_box(scene, "Inner_inside", Vec3(0), Vec3(2), true);
    test::add_box(scene, "Inner_outside", Vec3(0), Vec3(2.02), false);
    test::add_monitor(scene, "Monitor_R", 0, {0, 0, -0.95}, {0.4, 0, 0}, {0, 0.3, 0});
    const Bake result = bake(scene, small(256), {});
    const Texels texels = find_texels(scene, result.atlas);
    size_t dark = 0, lit = 0;
    for (const Texel& texel : texels.texels) {
        if (result.pages[0].state[0].pixels[texel.index] != TexelState::covered) continue;
        const float v = result.pages[0].map.visibility.pixels[texel.index].x;
        if (result.atlas.charts[texel.chart].surface == outer) {
            EXPECT_EQ(v, 0.f) << texel.index;
            ++dark;
        } else if (scene.surfaces[result.atlas.charts[texel.chart].surface].name == "Inner_inside") {
            EXPECT_EQ(v, 1.f) << texel.index;
            ++lit;
        }
    }
    EXPECT_GT(dark, 1000u);
    EXPECT_GT(lit, 100u);
}

TEST(ClosedBox, AMonitorDoesNotBlockItselfButBlocksTheOthers_M2) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    test::add_monitor(scene, "Far", 0, {0, 3, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    test::add_monitor(scene, "Near", 1, {0, 2, 0}, {5, 0, 0}, {0, 0, 5});  // hides the far one wholly
    const Bake result = bake(scene, small(64), {});
    size_t seen = 0;
    for (const Texel& texel : find_texels(scene, result.atlas).texels) {
        if (result.atlas.charts[texel.chart].surface != floor) continue;
        EXPECT_EQ(result.pages[0].map.visibility.pixels[texel.index], Vec3f(0, 1, 1));
        ++seen;
    }
    EXPECT_GT(seen, 100u);
}

TEST(Bake, TheSameBytesForOneThreadAndForMany) {
    const Scene scene = test::kanikama_room();
    set_thread_count(1);
    const Bake one = bake(scene, small(128), {});
    set_thread_count(7);
    const Bake many = bake(scene, small(128), {});
    set_thread_count(0);
    ASSERT_EQ(one.pages[0].map.visibility.pixels.size(), many.pages[0].map.visibility.pixels.size());
    EXPECT_EQ(one.pages[0].map.visibility.pixels, many.pages[0].map.visibility.pixels);
    for (size_t c = 0; c < 2; ++c) {
        EXPECT_EQ(one.pages[0].state[c].pixels, many.pages[0].state[c].pixels);
        for (size_t i = 0; i < one.pages[0].irradiance[c].pixels.size(); ++i) {
            EXPECT_EQ(one.pages[0].irradiance[c].pixels[i].shadowed, many.pages[0].irradiance[c].pixels[i].shadowed);
            EXPECT_EQ(one.pages[0].irradiance[c].pixels[i].unshadowed,
                      many.pages[0].irradiance[c].pixels[i].unshadowed);
        }
    }
}

TEST(Bake, ColourAndIntensityDoNotChangeTheMap) {
    Scene scene = test::kanikama_room();
    const Bake before = bake(scene, small(64), {});
    scene.monitors[0].radiance = {1000, 3, 0.01};
    EXPECT_EQ(before.pages[0].map.visibility.pixels, bake(scene, small(64), {}).pages[0].map.visibility.pixels);
}

TEST(Bake, StopsWhenCancelled) {
    const Scene scene = test::kanikama_room();
    Progress progress;
    progress.is_cancelled = [] { return true; };
    EXPECT_THROW(bake(scene, small(128), progress), Error);
}

TEST(Bake, WarnsOfAMonitorThatFacesAWall) {
    Scene scene;
    test::add_box(scene, "Room", Vec3(0), Vec3(4), true);
    test::add_monitor(scene, "Flipped", 0, {0, 0, -1.95}, {-0.8, 0, 0}, {0, 0.45, 0});  // towards -z, 5 cm away
    test::add_monitor(scene, "Good", 1, {1.95, 0, 0}, {0, 0, 0.8}, {0, 0.45, 0});
    const auto warnings = bake(scene, small(64), {}).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("Flipped shines towards -Z"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace surimi
