// SPDX-License-Identifier: Apache-2.0
#include "baked_file.h"

#include <gtest/gtest.h>

namespace surimi::test {
namespace {

TEST(BakedMaterials, ASecondSetThatMaterialsReadMoves) {
    QuadFile file;
    const std::vector<float> old_uv{0, 0, 9, 0, 9, 9, 0, 9};
    Json& attributes = file.first_primitive()["attributes"];
    attributes["TEXCOORD_0"] = file.add_floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    attributes["TEXCOORD_1"] = file.add_floats(old_uv, "VEC2");
    file.json["images"] = {{{"mimeType", "image/png"}, {"bufferView", file.add_view(png)}}};
    file.json["textures"] = {{{"source", 0}}};
    const Json transform{{"KHR_texture_transform", {{"texCoord", 1}, {"scale", {2, 2}}}}};
    file.json["materials"] = {{{"occlusionTexture", {{"index", 0}, {"texCoord", 1}}},
                               {"emissiveTexture", {{"index", 0}, {"extensions", transform}}},
                               {"normalTexture", {{"index", 0}}}}};
    file.first_primitive()["material"] = 0;
    Json other = file.primitive();  // shares the material, but has no second set to move
    other["material"] = 0;
    file.json["meshes"].push_back({{"primitives", {other}}});
    file.add_node({{"mesh", 1}});
    const Baked baked(file, joined_atlas);
    const Json& primitive = baked.file.primitive(0);
    EXPECT_EQ(baked.file.values<float>(primitive["attributes"]["TEXCOORD_2"]), old_uv);
    const Json& moved = baked.file.json["materials"][primitive["material"].get<size_t>()];
    EXPECT_EQ(moved["occlusionTexture"]["texCoord"], 2);
    EXPECT_EQ(moved["emissiveTexture"]["extensions"]["KHR_texture_transform"]["texCoord"], 2);
    EXPECT_EQ(moved["normalTexture"], Json({{"index", 0}}));
    EXPECT_NE(baked.file.primitive(1)["material"], primitive["material"]);
}

Json map_anchor(const Json& texture) {
    return {{"index", texture}, {"texCoord", 1}};
}

TEST(BakedMaterials, MaterialsCarryTheMapOnALayerThatIsOff) {
    QuadFile file;
    file.json["materials"] = {
        {{"name", "plain"}},
        {{"name", "coated"}, {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}}}}}},
        {{"name", "unlit"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}},
        {{"name", "odd"}, {"extras", "text"}}};
    file.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_unlit"};
    file.json["meshes"][0]["primitives"] = Json::array();
    for (int m = -1; m < 4; ++m) {
        Json primitive = file.primitive();
        if (m >= 0) primitive["material"] = m;
        file.json["meshes"][0]["primitives"].push_back(primitive);
    }
    const Baked baked(file, joined_atlas);
    const Json& materials = baked.file.json["materials"];
    ASSERT_EQ(materials.size(), 5);
    const Json mark{{"version", 1}, {"encoding", "srgb"}, {"channels", {"Screen", "", ""}}};
    EXPECT_EQ(materials[0]["extensions"]["KHR_materials_clearcoat"],
              Json({{"clearcoatFactor", 0}, {"clearcoatTexture", map_anchor(0)}}));
    EXPECT_EQ(materials[0]["extras"]["visibilityMap"], mark);
    EXPECT_EQ(materials[1]["extensions"]["KHR_materials_clearcoat"], Json({{"clearcoatFactor", 0.5}}));
    EXPECT_EQ(materials[1]["extensions"]["KHR_materials_sheen"],
              Json({{"sheenColorFactor", {0, 0, 0}}, {"sheenColorTexture", map_anchor(0)}}));
    EXPECT_EQ(materials[2]["extensions"].size(), 1);
    EXPECT_EQ(materials[2]["extras"]["visibilityMap"]["file"], "room.visibility.png");
    EXPECT_EQ(materials[3]["extras"], "text");
    EXPECT_TRUE(materials[3]["extensions"].contains("KHR_materials_clearcoat"));
    EXPECT_EQ(materials[4]["extras"]["visibilityMap"], mark) << "the default material, written out";
    EXPECT_EQ(baked.file.primitive(0, 0)["material"], 4);
    EXPECT_EQ(baked.file.json["extensionsUsed"],
              Json({"KHR_materials_clearcoat", "KHR_materials_unlit", "KHR_materials_sheen"}));
    EXPECT_FALSE(baked.file.json.contains("extensionsRequired"));
    const Json& texture = baked.file.json["textures"][0];
    const Json& image = baked.file.json["images"][texture["source"].get<size_t>()];
    EXPECT_EQ(image["mimeType"], "image/png");
    EXPECT_EQ(baked.file.view(image["bufferView"].get<size_t>()), png);
}

TEST(BakedMaterials, WhoHasNoMapSharesNoMaterialWithWhoHas) {
    QuadFile file;
    file.json["materials"] = {{{"name", "all"}}};
    file.first_primitive()["material"] = 0;
    Json lines = file.first_primitive();
    lines["mode"] = 1;
    file.json["meshes"][0]["primitives"].push_back(lines);
    const Baked baked(file, joined_atlas);
    EXPECT_EQ(baked.file.json["materials"][0], file.json["materials"][0]);
    EXPECT_EQ(baked.file.primitive(0, 1)["material"], 0);
    EXPECT_EQ(baked.file.primitive(0, 0)["material"], 1);
    EXPECT_EQ(baked.file.json["materials"][1]["name"], "all");
}

TEST(BakedMaterials, MonitorsAreMarkedAndCarryNoMap) {
    QuadFile file;
    file.add_node({{"name", "Screen"}, {"mesh", 0}, {"extras", {{"size", 7}}}});
    file.add_node({{"name", "Old"}, {"extras", {{"monitor", "G"}}}});
    const Baked baked(file, joined_atlas, [](Scene& scene) {
        Monitor monitor;
        monitor.name = "Screen";
        monitor.node = 1;
        monitor.panels = {Polygon{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}}};
        scene.surfaces[1].monitor = 0;
        scene.monitors.push_back(monitor);
    });
    EXPECT_EQ(baked.file.json["nodes"][1]["extras"], Json({{"size", 7}, {"monitor", "R"}}));
    EXPECT_EQ(baked.file.json["nodes"][2]["extras"]["monitor"], false);
    EXPECT_FALSE(baked.file.primitive(1).contains("material"));
    EXPECT_TRUE(baked.file.primitive(1)["attributes"].contains("TEXCOORD_1"));
}

TEST(BakedMaterials, MonitorsOfTheConfigurationGetANode) {
    QuadFile file;
    const Baked baked(file, joined_atlas, [](Scene& scene) {
        Monitor monitor;
        monitor.name = "Screen";
        monitor.channel = 2;
        monitor.radiance = Vec3(4, 2, 0);
        monitor.panels = {Polygon{{Vec3(0, 0, 3), Vec3(1, 0, 3), Vec3(1, 1, 3), Vec3(0, 1, 3)}}};
        scene.monitors.push_back(monitor);
    });
    const Json& node = baked.file.json["nodes"][1];
    EXPECT_EQ(node["name"], "Screen");
    EXPECT_EQ(node["extras"]["monitor"], "B");
    EXPECT_EQ(baked.file.json["scenes"][0]["nodes"], Json({0, 1}));
    const Scene back = read_gltf(baked.write(baked.scene.path.parent_path() / "baked.glb"));
    ASSERT_EQ(back.surfaces.size(), 2u);
    EXPECT_EQ(back.surfaces[1].triangles.size(), 2u);
    EXPECT_EQ(back.surfaces[1].positions[2], Vec3(1, 1, 3));
    EXPECT_EQ(back.materials[static_cast<size_t>(back.surfaces[1].material)].emissive, Vec3(4, 2, 0));
}

TEST(BakedMaterials, BakingABakedFileAddsNothing) {
    QuadFile file;
    file.json["materials"] = {{{"name", "paint"}}};
    file.first_primitive()["material"] = 0;
    const Baked once(file, scattered_atlas);
    const Baked twice(once.write(once.scene.path), [](const Scene& scene) {
        Atlas atlas = scattered_atlas(scene);
        for (auto& corners : atlas.surfaces[0].uv)
            for (Vec2f& uv : corners) uv *= 2;  // another place, so that it is a new map
        return atlas;
    });
    EXPECT_EQ(twice.bytes.size(), once.bytes.size());
    EXPECT_EQ(twice.file.json["materials"], once.file.json["materials"]);
    EXPECT_EQ(twice.file.json["images"].size(), 1);
    EXPECT_EQ(twice.file.json["textures"].size(), 1);
    EXPECT_EQ(twice.file.json["accessors"].size(), once.file.json["accessors"].size());
}

// Blender does so to a list that holds null, as the marks of files of before had for unused channels.
TEST(BakedMaterials, AMapWhoseMarkBecameATextIsReplaced) {
    QuadFile file;
    file.json["images"] = {{{"uri", "data:image/png;base64," + png_base64}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"name", "paint"},
                               {"extensions",
                                {{"KHR_materials_clearcoat",
                                  {{"clearcoatFactor", 0}, {"clearcoatTexture", {{"index", 0}, {"texCoord", 1}}}}}}},
                               {"extras", {{"visibilityMap", "{'version': 1, 'channels': ['Screen', None, None]}"}}}}};
    file.json["extensionsUsed"] = {"KHR_materials_clearcoat"};
    file.first_primitive()["material"] = 0;
    const Baked baked(file, joined_atlas);
    const Json& material = baked.file.json["materials"][0];
    EXPECT_FALSE(material["extensions"].contains("KHR_materials_sheen"));
    EXPECT_EQ(material["extras"]["visibilityMap"]["channels"], Json({"Screen", "", ""}));
    const auto texture = material["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"]["index"].get<size_t>();
    const auto image = baked.file.json["textures"][texture]["source"].get<size_t>();
    EXPECT_EQ(baked.file.json["images"][image]["name"], "room.visibility");
}

TEST(BakedMaterials, WithoutAMapOnlyTheUvsAreNew) {
    QuadFile file;
    const Scene scene = read_gltf(file.write(test_folder() / "room.glb"));
    const auto bytes = make_baked_glb(scene, joined_atlas(scene), {});
    const GlbFile baked(bytes);
    EXPECT_FALSE(baked.json.contains("materials"));
    EXPECT_FALSE(baked.json.contains("images"));
    EXPECT_TRUE(baked.primitive(0)["attributes"].contains("TEXCOORD_1"));
}

}  // namespace
}  // namespace surimi::test
