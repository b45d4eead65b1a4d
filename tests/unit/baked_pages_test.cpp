// SPDX-License-Identifier: Apache-2.0
// A bake of several pages: its files, the materials that carry the maps, and who reads them back.
#include <gtest/gtest.h>

#include "baked_file.h"
#include "baker/write/manifest.h"
#include "baker/write/output.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/visibility/baked.h"

namespace surimi::test {
namespace {

constexpr const char* clearcoat = "KHR_materials_clearcoat";

/// Three walls of one material; the second wall lies on the second page.
struct Walls : QuadFile {
    Walls() {
        json["materials"] = {{{"name", "paint"}}};
        first_primitive()["material"] = 0;
        add_node({{"name", "Left"}, {"mesh", 0}});
        add_node({{"name", "Right"}, {"mesh", 0}});
    }
};

Atlas two_pages(const Scene& scene) {
    Atlas atlas = joined_atlas(scene);
    atlas.pages = 2;
    atlas.surfaces[1].page = 1;
    return atlas;
}

/// A bake of such a scene. The first map is black but for R, the second is white.
struct TwoPages {
    std::filesystem::path folder = test_folder();
    Scene scene;
    Bake bake;

    TwoPages() {
        Walls walls;
        scene = read_gltf(walls.write(folder / "room.glb"));
        Monitor monitor;
        monitor.name = "Screen";
        monitor.panels = {Polygon{{Vec3(0, 0, 3), Vec3(0, 1, 3), Vec3(1, 1, 3), Vec3(1, 0, 3)}}};
        scene.monitors.push_back(monitor);
        bake.atlas = two_pages(scene);
        bake.atlas.width = bake.atlas.height = 8;
        for (const Vec3f& color : {Vec3f(0, 1, 1), Vec3f(1)}) {
            BakedPage& page = bake.pages.emplace_back();
            page.map.visibility = Image<Vec3f>(8, 8, color);
            page.map.monitors[0] = "Screen";
            page.state[0] = Image<TexelState>(8, 8, TexelState::covered);
            page.irradiance[0] = Image<IrradianceEstimate>(8, 8, {1, color.x, 0.25f * color.x});
        }
        bake.costs = {{"unwrap", 0.1, 0, 1}};
    }
};

TEST(BakedPages, AMaterialIsCopiedForEachPageThatItIsOn) {
    Walls walls;
    const Scene scene = read_gltf(walls.write(test_folder() / "room.glb"));
    const std::vector<uint8_t> other(png.begin(), png.end() - 4);  // told apart by its length
    const GlbFile file(make_baked_glb(scene, two_pages(scene), {{png, other}, {"Screen", "", ""}}));
    const Json& materials = file.json["materials"];
    ASSERT_EQ(materials.size(), 2);
    EXPECT_EQ(file.primitive(0)["material"], file.primitive(2)["material"]) << "both on the first page";
    for (size_t page = 0; page < 2; ++page) {
        const Json& material = materials[file.primitive(page)["material"].get<size_t>()];
        EXPECT_EQ(material["name"], "paint");
        EXPECT_EQ(material["extras"]["visibilityMap"],
                  Json({{"version", 1}, {"encoding", "srgb"}, {"channels", {"Screen", "", ""}}, {"page", page}}));
        const Json& use = material["extensions"][clearcoat]["clearcoatTexture"];
        EXPECT_EQ(use["texCoord"], 1);
        const Json& texture = file.json["textures"][use["index"].get<size_t>()];
        EXPECT_EQ(texture["name"], "room.visibility." + std::to_string(page));
        const Json& image = file.json["images"][texture["source"].get<size_t>()];
        EXPECT_EQ(file.view(image["bufferView"].get<size_t>()), page == 0 ? png : other);
    }
}

TEST(BakedPages, APageWithoutReceiversHasNoTexture) {
    Walls walls;
    Scene scene = read_gltf(walls.write(test_folder() / "room.glb"));
    scene.surfaces[1].monitor = 0;
    const GlbFile file(make_baked_glb(scene, two_pages(scene), {{png, png}, {"Screen", "", ""}}));
    EXPECT_EQ(file.json["textures"].size(), 1);
    EXPECT_EQ(file.json["images"].size(), 1);
}

TEST(BakedPages, WithoutAMapMaterialsSayThePageAlone) {
    Walls walls;
    const Scene scene = read_gltf(walls.write(test_folder() / "room.glb"));
    const GlbFile file(make_baked_glb(scene, two_pages(scene), {}));
    ASSERT_EQ(file.json["materials"].size(), 2);
    const Json& second = file.json["materials"][file.primitive(1)["material"].get<size_t>()];
    EXPECT_EQ(second["extras"]["visibilityMap"], Json({{"version", 1}, {"texCoord", 1}, {"page", 1}}));
    EXPECT_FALSE(second.contains("extensions"));
    EXPECT_FALSE(file.json.contains("textures"));
}

TEST(BakedPages, BakingAgainWithFewerPagesLeavesNothingBehind) {
    Walls walls;
    const std::filesystem::path path = test_folder() / "room.glb";
    const Scene scene = read_gltf(walls.write(path));
    const auto write = [&](const std::vector<uint8_t>& bytes) {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    };
    const std::vector<uint8_t> once = make_baked_glb(scene, joined_atlas(scene), map_of_screen);
    write(make_baked_glb(scene, two_pages(scene), {{png, png}, {"Screen", "", ""}}));
    const Scene again = read_gltf(path);
    Atlas moved = joined_atlas(again);
    for (SurfaceUv& surface : moved.surfaces)
        for (auto& corners : surface.uv)
            for (Vec2f& uv : corners) uv *= 2;  // another place, so that it is a new map
    const GlbFile file(make_baked_glb(again, moved, map_of_screen));
    EXPECT_EQ(file.json["textures"].size(), 1);
    EXPECT_EQ(file.json["images"].size(), 1);
    EXPECT_EQ(file.json["bufferViews"].size(), GlbFile(once).json["bufferViews"].size());
    EXPECT_EQ(file.json["textures"][0]["name"], "room.visibility");
    for (const Json& material : file.json["materials"])
        EXPECT_FALSE(material["extras"]["visibilityMap"].contains("page"));
    // And back to two.
    write(make_baked_glb(again, moved, map_of_screen));
    const Scene single = read_gltf(path);
    const GlbFile two(make_baked_glb(single, two_pages(single), {{png, png}, {"Screen", "", ""}}));
    EXPECT_EQ(two.json["textures"].size(), 2);
    EXPECT_EQ(two.json["images"].size(), 2);
}

TEST(BakedPages, EveryPageHasFilesOfItsOwn) {
    const TwoPages two;
    const OutputPaths paths = write_bake(two.folder / "out", two.scene, two.bake, "{}");
    ASSERT_EQ(paths.pages.size(), 2u);
    EXPECT_EQ(paths.pages[1].visibility_exr.filename(), "room.visibility.1.exr");
    EXPECT_EQ(paths.pages[1].visibility_png.filename(), "room.visibility.1.png");
    EXPECT_EQ(paths.pages[1].lightmaps_exr.filename(), "room.lightmaps.1.exr");
    const std::vector<std::filesystem::path> all = paths.all();
    EXPECT_EQ(all.size(), 8u);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(two.folder / "out"), {}), 8);
    for (const auto& path : all) EXPECT_TRUE(std::filesystem::exists(path)) << path;
    EXPECT_EQ(read_map_exr(paths.pages[0].visibility_exr).visibility.pixels[0], Vec3f(0, 1, 1));
    EXPECT_EQ(read_map_exr(paths.pages[1].visibility_exr).visibility.pixels[0], Vec3f(1));
    EXPECT_EQ(read_channels(paths.pages[1].lightmaps_exr).values.size(), 64u * 5);
}

TEST(BakedPages, TheManifestSaysWhatLiesWhere) {
    const TwoPages two;
    const OutputPaths paths = write_bake(two.folder / "out", two.scene, two.bake, "{}");
    std::ifstream stream(paths.manifest_json);
    const Json manifest = Json::parse(stream);
    EXPECT_EQ(manifest["map"]["files"].size(), 4);
    EXPECT_EQ(manifest["map"]["pages"],
              Json({{{"page", 0}, {"files", {"room.visibility.0.exr", "room.visibility.0.png"}}},
                    {{"page", 1}, {"files", {"room.visibility.1.exr", "room.visibility.1.png"}}}}));
    ASSERT_EQ(manifest["nodes"].size(), 3);
    for (size_t n = 0; n < 3; ++n) EXPECT_EQ(manifest["nodes"][n]["page"], n == 1 ? 1 : 0);
    ASSERT_EQ(manifest["outputs"].size(), 7);
    EXPECT_EQ(manifest["outputs"][5]["page"], 1);
    EXPECT_FALSE(manifest["outputs"][6].contains("page")) << "the glb is of all pages";
    EXPECT_EQ(manifest["texels"]["R"]["covered"], 128);
    EXPECT_EQ(manifest["error"]["R"]["mean"], 0.125);
    EXPECT_EQ(manifest["error"]["R"]["max"], 0.25);
}

TEST(BakedPages, ANodeOnTwoPagesHasARectangleOnEach) {
    TwoPages two;
    two.scene.surfaces[1].node = 0;
    const Json manifest = Json::parse(make_manifest(two.scene, two.bake, "{}", "", {}));
    ASSERT_EQ(manifest["nodes"].size(), 3);
    EXPECT_EQ(manifest["nodes"][0]["node"], 0);
    EXPECT_EQ(manifest["nodes"][1]["node"], 0);
    EXPECT_EQ(manifest["nodes"][0]["page"], 0);
    EXPECT_EQ(manifest["nodes"][1]["page"], 1);
    EXPECT_NE(manifest["nodes"][0]["st"], manifest["nodes"][1]["st"]);
}

TEST(BakedPages, PointsReadTheMapOfTheirPage) {
    const TwoPages two;
    const Scene back = read_gltf(write_bake(two.folder / "out", two.scene, two.bake, "{}").baked_glb);
    EXPECT_EQ(page_count(back), 2u);
    const std::vector<VisibilityMap> pages = carried_pages(back);
    ASSERT_EQ(pages.size(), 2u);
    for (uint32_t s = 0; s < 3; ++s) {
        const SurfacePoint at = surface_point(back, {s, 0}, Vec3(1.0 / 3));
        EXPECT_EQ(baked_visibility(back, pages, at), s == 1 ? Vec3(1) : Vec3(0, 1, 1)) << s;
    }
    EXPECT_EQ(map_at(back, {pages[0]}, surface_point(back, {1, 0}, Vec3(1.0 / 3))), nullptr);
    EXPECT_TRUE(carried_pages(two.scene).empty());
}

}  // namespace
}  // namespace surimi::test
