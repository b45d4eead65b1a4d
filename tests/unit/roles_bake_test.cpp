// SPDX-License-Identifier: Apache-2.0
// What bakes, files and pictures make of surfaces that do not cast, do not receive, or are excluded.
#include <gtest/gtest.h>

#include <algorithm>

#include "baker/bake.h"
#include "baker/gather/monitor_setup.h"
#include "baker/reach.h"
#include "baker/unwrap/existing.h"
#include "baker/unwrap/measure.h"
#include "runtime/base/error.h"
#include "runtime/scene/roles.h"
#include "runtime/visibility/baked.h"
#include "tests/support/scenes.h"
#include "tests/unit/baked_file.h"
#include "tests/unit/role_marks.h"
#include "tests/unit/square_glb.h"
#include "tests/unit/uv_scenes.h"

namespace surimi::test {
namespace {

BakeSettings small(Method method = Method::automatic) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = 48;
    settings.unwrap.quality = UvQuality::draft;
    settings.gather.method = method;
    return settings;
}

/// A floor, a monitor above it that faces down, and nothing between.
Scene empty_room() {
    Scene scene;
    add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
    return scene;
}

constexpr uint32_t floor_surface = 0, box_surface = 2;

/// The same with a box between.
Scene room_with(const std::string& box) {
    Scene scene = empty_room();
    EXPECT_EQ(add_box(scene, box, {0.1, 1, 0.1}, {0.7, 0.5, 0.6}), box_surface);
    return scene;
}

/// Visibility of the texels of a surface that have light.
std::vector<float> visibilities(const Scene& scene, const Bake& bake, uint32_t surface) {
    std::vector<float> values;
    for (const Texel& texel : find_texels(scene, bake.atlas).texels)
        if (bake.atlas.charts[texel.chart].surface == surface &&
            bake.pages[0].irradiance[0].pixels[texel.index].unshadowed > 0)
            values.push_back(bake.pages[0].map.visibility.pixels[texel.index].x);
    return values;
}

size_t texels_of(const Scene& scene, const Bake& bake, uint32_t surface) {
    const Texels all = find_texels(scene, bake.atlas);
    return static_cast<size_t>(std::ranges::count_if(
        all.texels, [&](const Texel& texel) { return bake.atlas.charts[texel.chart].surface == surface; }));
}

void expect_all_one(const std::vector<float>& values) {
    EXPECT_GT(values.size(), 200u);
    for (const float v : values) EXPECT_EQ(v, 1);
}

TEST(RolesOfBakes, ACollisionMeshLeavesTheMapAsWithoutIt) {
    Scene scene = room_with("Floor_collider");
    apply_roles(scene, {});
    for (const Method method : {Method::automatic, Method::split, Method::scanline, Method::monte_carlo}) {
        const Bake with = bake(scene, small(method), {});
        expect_all_one(visibilities(scene, with, floor_surface));
        EXPECT_EQ(texels_of(scene, with, box_surface), 0u);
        EXPECT_EQ(with.pages[0].map.visibility.pixels,
                  bake(empty_room(), small(method), {}).pages[0].map.visibility.pixels);
    }
}

TEST(RolesOfBakes, WhatDoesNotCastGetsTexelsAllTheSame) {
    Scene scene = room_with("Box");
    const auto shadowed = visibilities(scene, bake(scene, small(), {}), floor_surface);
    EXPECT_LT(*std::ranges::min_element(shadowed), 0.1f) << "there is a shadow to lose";
    apply_roles(scene, {.objects = {{"Box", casts(false)}}});
    for (const Method method : {Method::automatic, Method::split, Method::scanline, Method::monte_carlo}) {
        const Bake result = bake(scene, small(method), {});
        expect_all_one(visibilities(scene, result, floor_surface));
        EXPECT_GT(visibilities(scene, result, box_surface).size(), 20u);
        for (const float v : visibilities(scene, result, box_surface)) EXPECT_EQ(v, 1) << "nor on itself";
    }
}

TEST(RolesOfBakes, WhatDoesNotReceiveCastsAllTheSame) {
    Scene scene = room_with("Box");
    apply_roles(scene, {.objects = {{"Box", receives(false)}}});
    const Bake result = bake(scene, small(), {});
    EXPECT_EQ(texels_of(scene, result, box_surface), 0u);
    EXPECT_TRUE(result.atlas.surfaces[box_surface].uv.empty());
    const auto shadowed = visibilities(scene, result, floor_surface);
    EXPECT_LT(*std::ranges::min_element(shadowed), 0.1f);
    EXPECT_EQ(*std::ranges::max_element(shadowed), 1);
    const UnwrapNumbers numbers = measure(scene, result.atlas);
    EXPECT_EQ(numbers.triangles, 4u) << "floor and monitor";
    EXPECT_NEAR(numbers.area, 16 + area(scene.monitors[0]), 1e-6);
    EXPECT_EQ(numbers.charts, 2u);
}

TEST(RolesOfBakes, GlassIsAWallOrAir) {
    Scene scene = room_with("Pane");
    scene.materials.emplace_back().transmission = 1;
    scene.surfaces[box_surface].material = 0;
    apply_roles(scene, {Glass::block, {}});
    const auto shadowed = visibilities(scene, bake(scene, small(), {}), floor_surface);
    EXPECT_LT(*std::ranges::min_element(shadowed), 0.1f);
    apply_roles(scene, {Glass::clear, {}});
    const Bake clear = bake(scene, small(), {});
    expect_all_one(visibilities(scene, clear, floor_surface));
    EXPECT_GT(texels_of(scene, clear, box_surface), 20u);
}

TEST(RolesOfBakes, AnAlphaMaskedSheetThatDoesNotCastLetsAllThrough) {
    Scene scene = room_with("Leaves");
    scene.materials.emplace_back().alpha_mode = AlphaMode::mask;
    scene.surfaces[box_surface].material = 0;
    apply_roles(scene, {.objects = {{"Leaves", casts(false)}}});
    const Silhouettes silhouettes = find_silhouettes(scene, RayScene(scene));
    EXPECT_TRUE(silhouettes.cutouts.empty());
    expect_all_one(visibilities(scene, bake(scene, small(), {}), floor_surface));
}

TEST(RolesOfBakes, AMonitorThatDoesNotCastLetsTheLightOfOthersThrough) {
    for (const bool casts : {true, false}) {
        Scene scene = empty_room();
        add_monitor(scene, "Monitor_G", 1, {0.2, 1.2, 0}, {0.6, 0, 0}, {0, 0, 0.5});
        scene.surfaces[2].casts = casts;
        const auto values = visibilities(scene, bake(scene, small(), {}), floor_surface);
        EXPECT_EQ(*std::ranges::min_element(values) < 0.5f, casts);
    }
}

TEST(RolesOfBakes, WithoutAReceiverThereIsNothingToBake) {
    Scene scene = room_with("Box");
    apply_roles(scene, {.objects = {{"*", receives(false)}}});
    try {
        bake(scene, small(), {});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::nothing_to_bake);
        EXPECT_TRUE(mentions(error.what(), "receives = true")) << error.what();
    }
}

TEST(RolesOfBakes, NothingHasEdgesOrPlanesThatDoesNotCast) {
    Scene scene = room_with("Box");
    apply_roles(scene, {.objects = {{"Box", casts(false)}}});
    // The box also stands across the plane of the monitor, where edges are made of it.
    for (Vec3& p : scene.surfaces[box_surface].positions) p.y += 1.5;
    const RayScene rays(scene);
    const Silhouettes silhouettes = find_silhouettes(scene, rays);
    const Scene alone = empty_room();
    EXPECT_EQ(silhouettes.edges.size(), find_silhouettes(alone, RayScene(alone)).edges.size());
    ASSERT_EQ(silhouettes.plane_of[box_surface].size(), scene.surfaces[box_surface].triangles.size());
    for (const uint32_t plane : silhouettes.plane_of[box_surface]) EXPECT_EQ(plane, Edge::no_plane);
    EXPECT_TRUE(set_up(scene, rays, silhouettes, 0, {}).cuts[0].edges.empty());
    scene.surfaces[box_surface].casts = true;
    const RayScene all(scene);
    EXPECT_FALSE(set_up(scene, all, find_silhouettes(scene, all), 0, {}).cuts[0].edges.empty());
}

TEST(RolesOfBakes, NoMonitorReachesWhatDoesNotReceive) {
    Scene scene = room_with("Box");
    const BakeSettings settings = small();
    EXPECT_GT(find_reach(scene, prepare(scene, settings, {}), 0, settings.gather)[box_surface].facing, 0);
    apply_roles(scene, {.objects = {{"Box", receives(false)}}});
    const auto reach = find_reach(scene, prepare(scene, settings, {}), 0, settings.gather);
    EXPECT_EQ(reach[box_surface].facing, 0);
    EXPECT_EQ(reach[box_surface].blocks.seen, 0u);
    EXPECT_GT(reach[floor_surface].facing, 0.9);
}

TEST(RolesOfExistingUvs, WhatDoesNotReceiveNeedsNone) {
    Scene scene = two_quads(2);
    scene.surfaces.insert(scene.surfaces.begin(), scene.surfaces[0]);
    UnwrapSettings settings;
    settings.width = settings.height = uv_map;
    EXPECT_TRUE(mentions(judge_existing(scene, settings).fault, "overlaps"));
    scene.surfaces[0].receives = false;
    ExistingUv found = judge_existing(scene, settings);
    EXPECT_EQ(found.fault, "");
    EXPECT_EQ(found.atlas.charts.size(), 2u);
    EXPECT_EQ(found.atlas.charts[0].surface, 1u);
    EXPECT_TRUE(found.atlas.surfaces[0].uv.empty());
    EXPECT_NEAR(found.atlas.texels_per_metre, 16, 1e-5) << "by the others' area alone";
    scene.surfaces[0].uv_sets.clear();
    EXPECT_EQ(judge_existing(scene, settings).fault, "");
    EXPECT_EQ(chart_sides(scene, found.atlas).size(), 8u);
    EXPECT_EQ(measure(scene, found.atlas).triangles, 4u);
}

TEST(RolesOfUnwraps, PagesHoldReceiversAlone) {
    Scene scene = room_with("Box");
    apply_roles(scene, {.objects = {{"Box", receives(false)}}});
    UnwrapSettings settings = small().unwrap;
    settings.atlases = 3;
    const Atlas atlas = unwrap(scene, settings, {});
    EXPECT_EQ(atlas.pages, 2) << "no page without a chart";
    for (const Chart& chart : atlas.charts) EXPECT_NE(chart.surface, box_surface);
    for (const SurfaceUv& surface : atlas.surfaces) EXPECT_TRUE(surface.page >= 0 && surface.page < atlas.pages);
}

/// As an unwrap leaves it: what does not receive is nowhere.
Atlas atlas_of_receivers(const Scene& scene) {
    Atlas atlas = scattered_atlas(scene);
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        if (!scene.surfaces[s].receives) atlas.surfaces[s] = {};
    return atlas;
}

TEST(RolesOfFiles, AnExcludedNodeStaysInTheFileAsItWas) {
    QuadFile file;
    file.json["materials"] = {{{"name", "Paint"}}};
    file.first_primitive()["material"] = 0;
    file.add_node({{"name", "Wall_collider"}, {"mesh", 0}, {"scale", {-1, 1, 1}}});  // mirrored, of the same mesh
    file.add_node({{"name", "Flat"}, {"mesh", 0}, {"scale", {0, 0, 0}}});
    const Baked baked(file, atlas_of_receivers, [](Scene& scene) { apply_roles(scene, {}); });
    const Json& wall = baked.file.primitive(0);
    const Json& collider = baked.file.primitive(1);
    EXPECT_TRUE(wall["attributes"].contains("TEXCOORD_1"));
    EXPECT_TRUE(baked.file.json["materials"][wall["material"].get<size_t>()].contains("extras"));
    EXPECT_FALSE(collider["attributes"].contains("TEXCOORD_1"));
    EXPECT_EQ(baked.file.json["materials"][collider["material"].get<size_t>()], Json({{"name", "Paint"}}));
    EXPECT_EQ(baked.file.corners(collider).size(), 6u);
    EXPECT_EQ(baked.file.json["nodes"].size(), 3u);
    EXPECT_EQ(baked.file.json["nodes"][1]["name"], "Wall_collider");
    const Scene back = read_gltf(baked.write(test_folder() / "baked.glb"));
    EXPECT_EQ(triangle_count(back), triangle_count(baked.scene));
}

TEST(RolesOfPictures, WhatDoesNotCastIsSeenAndLightPasses) {
    Scene scene = room_with("Box");
    const Vec3 above(0.1, 2, 0.1), below(0.1, 0.1, 0.1);
    const Vec3 down(0, -1, 0);
    const auto first_hit = [&](Attach attach) {
        const RayScene rays(scene, attach);
        const auto hit = rays.closest_hit(above, down);
        EXPECT_EQ(rays.is_occluded(below, above, RayScene::no_monitor), scene.surfaces[box_surface].casts);
        EXPECT_EQ(rays.closest_occluder(below - rays.center(), above - rays.center(), 1, 0).has_value(),
                  scene.surfaces[box_surface].casts);
        RayPacket packet;
        packet.add(below - rays.center(), above - rays.center(), 1);
        EXPECT_EQ(rays.occluded(packet, RayScene::no_monitor) != 0, scene.surfaces[box_surface].casts);
        return hit ? hit->triangle.surface : UINT32_MAX;
    };
    EXPECT_EQ(first_hit(Attach::casters), box_surface);
    EXPECT_EQ(first_hit(Attach::everything), box_surface);
    apply_roles(scene, {.objects = {{"Box", exclude(true)}}});
    EXPECT_EQ(first_hit(Attach::casters), floor_surface);
    EXPECT_EQ(first_hit(Attach::everything), box_surface);
    scene.nodes[static_cast<size_t>(scene.surfaces[box_surface].node)].name = "Box_collider";
    apply_roles(scene, {});
    EXPECT_EQ(first_hit(Attach::everything), floor_surface) << "engines do not draw collision meshes";
}

TEST(RolesOfPictures, NoMapIsReadOnWhatDoesNotReceive) {
    Scene scene = two_quads(2);
    std::vector<VisibilityMap> pages(1);
    pages[0].visibility = Image<Vec3f>(4, 4, Vec3f(0.25f));
    const SurfacePoint at = surface_point(scene, {0, 0}, Vec3(1.0 / 3));
    EXPECT_NEAR(baked_visibility(scene, pages, at).x, 0.25, 1e-6);
    scene.surfaces[0].receives = false;
    EXPECT_EQ(baked_visibility(scene, pages, at), Vec3(1));
    EXPECT_EQ(map_at(scene, pages, at), nullptr);
}

}  // namespace
}  // namespace surimi::test
