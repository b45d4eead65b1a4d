// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "baker/bake.h"
#include "baker/gather/enclosure.h"
#include "baker/gather/gather.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/parallel.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr int size = 8;

/// A floor of 4 x 4 m under 8 x 8 texels of half a metre, a panel of 1 m^2 that shines down from 3 m above it.
struct Stage {
    Scene scene;
    Atlas atlas;
    std::vector<Texels> pages;
    ExposureCounts counts;

    Stage() {
        test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Lamp", 0, {0, 3, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    }
    void find() {
        const RayScene rays(scene);
        atlas = test::whole_map_atlas(scene, 0, size);
        pages = {find_texels(scene, atlas)};
        counts = find_exposures(scene, atlas, rays, pages);
    }
    const Texel& texel_at(double x, double z) const {
        // whole_map_atlas puts u along the quad's first side and v along its last
        const RayScene rays(scene);
        for (const Texel& texel : pages[0].texels) {
            const Vec3 middle = TexelSurface(scene, atlas, pages[0], texel).center().position;
            if (std::abs(middle.x - x) < 0.25 && std::abs(middle.z - z) < 0.25) return texel;
        }
        throw std::logic_error("no texel there");
    }
    TexelSurface exposed(const Texel& texel) const {
        const RayScene rays(scene);
        return exposed_surface({scene, atlas, pages[0], rays}, texel, panels_of(scene.monitors[0], rays));
    }
    Gathered light() const {
        const RayScene rays(scene);
        const Silhouettes silhouettes = find_silhouettes(scene, rays);
        return gather(scene, atlas, pages[0], rays, silhouettes, 0, {}, {});
    }
};

TEST(Follow, CountsWhatARayLeavesAgainstWhatItEnters_M65) {
    Scene scene;
    test::add_box(scene, "Outer", {0, 0, 0}, {4, 4, 4});
    test::add_box(scene, "Inner", {1, 0, 0}, {1, 1, 1});
    test::add_box(scene, "Through", {0, 2, 0}, {1, 2, 1});
    const RayScene rays(scene);
    const Vec3 right(0.998, 0.05, 0.04), up(0.03, 0.997, 0.05);
    EXPECT_TRUE(rays.follow({0, 0, 0}, right).comes_out) << "through a box in the box, and out";
    EXPECT_TRUE(rays.follow({0, 0, 0}, up).comes_out) << "into a box that sticks out, and out of both";
    EXPECT_TRUE(rays.follow({1, 0, 0}, right).comes_out);
    EXPECT_FALSE(rays.follow({-5, 0, 0}, right).comes_out) << "in and out again";
    EXPECT_FALSE(rays.follow({5, 0, 0}, right).comes_out) << "meets nothing";
    Scene room;
    test::add_box(room, "Room", {0, 0, 0}, {8, 8, 8}, true);
    test::add_box(room, "Box", {0, 0, 0}, {1, 1, 1});
    const RayScene in_room(room);
    EXPECT_TRUE(in_room.follow({0, 0, 0}, right).comes_out);
    EXPECT_FALSE(in_room.follow({2, 0, 0}, right).comes_out);
}

TEST(Exposure, NothingIsTouchedSoNothingIsProbed_M65) {
    Stage stage;
    test::add_box(stage.scene, "Floating", {0, 1, 0}, {1, 1, 1});
    stage.find();
    EXPECT_EQ(stage.counts.touched, 0u);
    EXPECT_EQ(stage.counts.probes, 0u);
    EXPECT_TRUE(std::ranges::all_of(stage.pages[0].texels,
                                    [](const Texel& t) { return t.free_pieces == Texel::all_pieces && !t.may_turn; }));
}

TEST(Exposure, BoxSunkIntoTheFloorHidesWhatItHolds_M65) {
    Stage stage;  // the box holds x in [-0.6, 0.9]: texels of 0.5 m, two whole ones and parts of two in a row
    test::add_box(stage.scene, "Sunk", {0.15, 0.2, 0}, {1.5, 1, 1});
    stage.find();
    EXPECT_TRUE(stage.texel_at(0.25, 0.25).is_inside());
    EXPECT_TRUE(stage.texel_at(-0.25, -0.25).is_inside());
    EXPECT_EQ(stage.texel_at(1.25, 0.25).free_pieces, Texel::all_pieces);
    EXPECT_EQ(stage.texel_at(0.25, 0.75).free_pieces, Texel::all_pieces);
    const Texel& right = stage.texel_at(0.75, 0.25);
    ASSERT_FALSE(right.is_inside());
    EXPECT_NEAR(stage.exposed(right).area(), 0.1 * 0.5, 1e-6) << "0.9 to 1";
    EXPECT_NEAR(stage.exposed(stage.texel_at(-0.75, 0.25)).area(), 0.4 * 0.5, 1e-6) << "-1 to -0.6";
    EXPECT_EQ(stage.counts.inside, 4u);
    EXPECT_EQ(stage.counts.partly, 4u);
}

TEST(Exposure, NoDarkRimBesideASunkBox_M65) {
    Stage stage;
    test::add_box(stage.scene, "Sunk", {0.15, 0.0, 0}, {1.5, 0.02, 1});  // so flat that it casts next to no shadow
    stage.find();
    const Gathered gathered = stage.light();
    for (size_t i = 0; i < gathered.estimates.size(); ++i) {
        const IrradianceEstimate& e = gathered.estimates[i];
        if (stage.pages[0].texels[i].is_inside()) {
            EXPECT_EQ(e.unshadowed, 0);
            continue;
        }
        EXPECT_GT(e.shadowed / e.unshadowed, 0.93) << "texel " << stage.pages[0].texels[i].index;
    }
}

TEST(Exposure, BoxThatStandsOnTheFloorHidesWhatIsUnderIt_M65) {
    Stage stage;
    test::add_box(stage.scene, "Standing", {0, 0.25, 0}, {1, 0.5, 1});  // its sides lie on borders of texels
    stage.find();
    EXPECT_EQ(stage.counts.inside, 4u);
    test::add_box(stage.scene, "Other", {-1.3, 0.25, -1.3}, {0.2, 0.5, 0.2});  // this one crosses a texel
    stage.find();
    EXPECT_EQ(stage.counts.inside, 4u);
    EXPECT_EQ(stage.counts.partly, 1u);
}

TEST(Exposure, SheetsEncloseNothing_M65) {
    Stage stage;
    test::add_quad(stage.scene, "Sheet", {0.1, 0, 1}, {0.1, 0, -1}, {0.1, 1, -1}, {0.1, 1, 1});
    test::add_quad(stage.scene, "Other", {-1.1, 0, -1}, {0.1, 0, -1}, {0.1, 1, -1}, {-1.1, 1, -1});
    Material material;
    material.double_sided = true;
    stage.scene.materials.push_back(material);
    for (Surface& surface : stage.scene.surfaces) surface.material = 0;
    stage.find();
    EXPECT_GT(stage.counts.crossed, 0u);
    EXPECT_EQ(stage.counts.inside + stage.counts.partly, 0u) << "two walls without thickness, seen from either side";
    stage.scene.materials[0].double_sided = false;
    stage.find();
    EXPECT_GT(stage.counts.inside + stage.counts.partly, 0u) << "nobody sees the backs, nor what is dark close behind";
    EXPECT_LT(stage.counts.inside, 4u);
}

TEST(Exposure, WhatLightReachesIsNotInside_M65) {
    Stage stage;  // a roof over the whole floor that shows its back to it, with the lamp below: all rays meet backs
    test::add_box(stage.scene, "Shell", {0, 2, 0}, {3.3, 4.2, 3.3});
    stage.find();
    EXPECT_GT(stage.counts.crossed, 0u);
    EXPECT_EQ(stage.counts.inside, 0u);
    ASSERT_EQ(stage.counts.warnings.size(), 1u);
    EXPECT_NE(stage.counts.warnings[0].find("flip them"), std::string::npos);
}

TEST(Exposure, TheJudgeKnowsFreeSpaceAndBoxes_M65) {
    Stage stage;
    const uint32_t floor = 0;
    test::add_box(stage.scene, "Sunk", {0, 0.2, 0}, {1, 1, 1});
    const RayScene rays(stage.scene);
    const EnclosureJudge judge(stage.scene, rays);
    EXPECT_TRUE(judge.is_reliable());
    for (uint64_t key = 0; key < 50; ++key) {
        const double t = 0.01 + 0.0196 * static_cast<double>(key);
        const SurfacePoint at = surface_point(stage.scene, {floor, 0}, {0.5, 0, 0.5});  // the floor's middle
        SurfacePoint inside = at, beside = at;
        inside.position = {0.49 * (2 * t - 1), 0, 0.3};
        beside.position = {0.51 + t, 0, 0.3};
        EXPECT_TRUE(judge.judge(inside, 0.1, key) == Enclosure::enclosed);
        EXPECT_FALSE(judge.judge(beside, 0.1, key) == Enclosure::enclosed);
    }
}

TEST(Exposure, CardIsLitOnWhicheverSideTheMonitorIs_M65) {
    for (const bool is_two_sided : {true, false}) {
        Stage stage;
        std::swap(stage.scene.surfaces[0].triangles[0][1], stage.scene.surfaces[0].triangles[0][2]);
        std::swap(stage.scene.surfaces[0].triangles[1][1], stage.scene.surfaces[0].triangles[1][2]);
        for (Vec3& normal : stage.scene.surfaces[0].normals) normal = -normal;  // the floor looks down
        stage.scene.surfaces[0].is_two_sided = is_two_sided;
        stage.find();
        EXPECT_EQ(stage.counts.turning, is_two_sided ? 64u : 0u);
        for (const IrradianceEstimate& e : stage.light().estimates) {
            EXPECT_EQ(e.unshadowed > 0, is_two_sided);
            if (is_two_sided) {
                EXPECT_EQ(e.shadowed, e.unshadowed);
            }
        }
    }
}

TEST(Exposure, BackOfAClosedBoxStaysUnlit_M65) {
    Stage stage;
    const uint32_t box = test::add_box(stage.scene, "Box", {0, 1, 0}, {1, 1, 1});
    stage.scene.surfaces[box].is_two_sided = true;
    const RayScene rays(stage.scene);
    stage.atlas = unwrap(stage.scene, {}, {});
    stage.pages = {find_texels(stage.scene, stage.atlas)};
    stage.counts = find_exposures(stage.scene, stage.atlas, rays, stage.pages);
    EXPECT_GT(stage.counts.probes, 0u);
    EXPECT_EQ(stage.counts.turning, 0u);
}

TEST(Exposure, SubtexelsOfAPartialTexelAreJudgedAlike_M65) {
    // Kanikama's pillars end in the planes of floor and ceiling: rays that leave through a coplanar face are not told
    // from those that enter.
    const Scene scene = test::kanikama_room();
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = 96;
    const Bake plain = bake(scene, settings, {});
    settings.gather.supersample = 4;
    const Bake fine = bake(scene, settings, {});
    size_t compared = 0;
    const auto& a = plain.pages[0].irradiance[0].pixels;
    const auto& b = fine.pages[0].irradiance[0].pixels;
    for (size_t i = 0; i < a.size(); ++i) {
        if (!(a[i].unshadowed > 0) || a[i].shadowed != a[i].unshadowed || !(b[i].unshadowed > 0)) continue;
        ++compared;
        EXPECT_GT(b[i].shadowed / b[i].unshadowed, 0.97f) << i;
    }
    EXPECT_GT(compared, 500u);
}

TEST(Exposure, SameForAnyNumberOfThreads) {
    std::vector<uint32_t> before;
    for (const int threads : {1, 4}) {
        set_thread_count(threads);
        Stage stage;
        test::add_box(stage.scene, "Sunk", {0.15, 0.2, 0.1}, {1.5, 1, 1.1});
        stage.find();
        std::vector<uint32_t> now;
        for (const Texel& texel : stage.pages[0].texels) now.push_back(texel.free_pieces);
        if (threads > 1) {
            EXPECT_EQ(now, before);
        }
        before = now;
    }
    set_thread_count(0);
}

}  // namespace
}  // namespace surimi
