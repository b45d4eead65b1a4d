// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf_materials.h"

#include "tests/unit/square_glb.h"

#include <gtest/gtest.h>

namespace surimi {
namespace {

using test::expect_near;
using test::Json;
using test::mentions;
using test::note_count;
using test::refusal;
using test::Square;

TEST(ReadMaterials, MaterialValuesAndTheirExtensions) {
    Square square;
    square.json["materials"] = {
        {{"name", "glow"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3},
         {"doubleSided", true},
         {"extras", {{"monitor", "G"}, {"monitor_two_sided", true}}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
           {"KHR_materials_unlit", Json::object()}}}}};
    square.primitive["material"] = 0;
    const Scene scene = square.read();
    const Material& m = scene.materials[0];
    EXPECT_EQ(scene.surfaces[0].material, 0);
    EXPECT_EQ(m.base_color, Vec4(0.1, 0.2, 0.3, 0.4));
    EXPECT_EQ(m.metallic, 0.25);
    EXPECT_EQ(m.roughness, 0.75);
    EXPECT_EQ(m.emissive, Vec3(8, 4, 0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.3);
    EXPECT_TRUE(m.double_sided && m.unlit && m.is_marked_monitor && m.is_two_sided_monitor);
    EXPECT_EQ(m.monitor_channel, 1);
    EXPECT_EQ(m.transmission, 0.9);
}

TEST(ReadMaterials, MaterialOutOfRangeIsAnError) {
    Square square;
    square.primitive["material"] = 3;
    EXPECT_TRUE(mentions(refusal(square.write(test::test_folder() / "material.glb")), "\"material\" is 3"));
}

// A red pixel as PNG.
constexpr const char* pixel_base64 =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";

struct TexturedSquare : Square {
    TexturedSquare() {
        json["images"] = {{{"uri", std::string("data:image/png;base64,") + pixel_base64}}};
        json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
        json["textures"] = {{{"source", 0}, {"sampler", 0}}};
        json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}}};
        primitive["material"] = 0;
    }
    Json& texture() { return json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]; }
};

TEST(ReadMaterials, TexturesNameImageSetAndWrap) {
    const Scene scene = TexturedSquare().read();
    const TextureUse& use = scene.materials[0].base_color_texture;
    EXPECT_EQ(use.image, 0);
    EXPECT_EQ(use.uv_set, 1);
    EXPECT_EQ(use.wrap_s, Wrap::clamp);
    EXPECT_EQ(use.wrap_t, Wrap::mirrored_repeat);
    ASSERT_EQ(scene.images[0].pixels.size(), 1u);
    EXPECT_EQ(scene.images[0].at(0, 0), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(note_count(scene, "UV set that the mesh lacks"), 1u);
}

TEST(ReadMaterials, UnusedImagesAreNotDecoded) {
    TexturedSquare square;
    square.json["images"].push_back(square.json["images"][0]);
    const Scene scene = square.read();
    ASSERT_EQ(scene.images.size(), 2u);
    EXPECT_TRUE(scene.images[1].empty());
}

TEST(ReadMaterials, TextureTransformIsThatOfTheSpecificationsExample) {
    TexturedSquare square;
    square.texture()["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", pi / 2}, {"scale", {0.5, 0.5}}, {"texCoord", 0}};
    const TextureUse use = square.read().materials[0].base_color_texture;
    EXPECT_EQ(use.uv_set, 0);
    // The extension's own example: the lower left quarter of the image, turned clockwise by 90 degrees; v points down.
    expect_near(use.transform * Vec3(0, 0, 1), Vec3(0, 1, 1));
    expect_near(use.transform * Vec3(1, 0, 1), Vec3(0, 0.5, 1));
    expect_near(use.transform * Vec3(0, 1, 1), Vec3(0.5, 1, 1));
}

TEST(ReadMaterials, CarriedVisibilityMapTakesItsTextureFromTheCarrier) {
    TexturedSquare square;
    square.json["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {
        {"clearcoatFactor", 0}, {"clearcoatTexture", {{"index", 0}, {"texCoord", 1}}}};
    square.json["materials"][0]["extras"]["visibilityMap"] = {
        {"version", 1}, {"encoding", "srgb"}, {"channels", {"Monitor_R", nullptr, "Monitor_B"}}};
    const Material m = square.read().materials[0];
    EXPECT_EQ(m.visibility_map.image, 0);
    EXPECT_EQ(m.visibility_map.uv_set, 1);
    EXPECT_TRUE(m.visibility_is_srgb);
    EXPECT_EQ(m.visibility_channels, (std::array<std::string, 3>{"Monitor_R", "", "Monitor_B"}));
}

TEST(ReadMaterials, CarriedVisibilityMapIsOnSheenWhereTheMaterialHasAClearcoat) {
    TexturedSquare square;
    square.json["materials"][0]["extensions"] = {
        {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}, {"clearcoatTexture", {{"index", 7}, {"texCoord", 0}}}}},
        {"KHR_materials_sheen",
         {{"sheenColorFactor", {0, 0, 0}}, {"sheenColorTexture", {{"index", 0}, {"texCoord", 1}}}}}};
    square.json["materials"][0]["extras"]["visibilityMap"] = {{"version", 1}, {"encoding", "srgb"}};
    const Material m = square.read().materials[0];
    EXPECT_EQ(m.visibility_map.image, 0);
    EXPECT_EQ(m.visibility_map.uv_set, 1);
}

TEST(ReadMaterials, MissingAndForeignImagesAreNotes) {
    for (const char* uri : {"gone.png", "/etc/hostname", "http://example.com/a.png", "file:///etc/hostname",
                            "data:image/png;base64,????"}) {
        TexturedSquare square;
        square.json["images"][0]["uri"] = uri;
        const Scene scene = square.read();
        EXPECT_TRUE(scene.images[0].empty());
        EXPECT_EQ(note_count(scene, "left out"), 1u) << uri;
    }
}

TEST(ReadMonitorMark, KnowsEveryWayToNameAChannel) {
    const auto mark = [](const Json& value) { return read_monitor_mark({{"extras", {{"monitor", value}}}}); };
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_EQ(mark(channel).channel, channel);
        EXPECT_EQ(mark(std::string(1, "RGB"[channel])).channel, channel);
    }
    EXPECT_TRUE(mark(true).is_marked);
    EXPECT_EQ(mark(true).channel, -1);
    EXPECT_FALSE(mark(true).is_unclear);
    EXPECT_FALSE(mark(false).is_marked);
    EXPECT_FALSE(read_monitor_mark(Json::object()).is_marked);
    EXPECT_TRUE(mark(7).is_marked && mark(7).is_unclear);
    EXPECT_TRUE(mark("left").is_unclear);
}

TEST(ReadTexelScale, IsReadFromNodesAndMaterials) {
    Square square;
    square.json["materials"] = {{{"name", "wood"}, {"extras", {{"texel_scale", 0.25}}}}};
    square.json["nodes"][0]["extras"] = {{"texel_scale", 3}};
    square.primitive["material"] = 0;
    const Scene scene = square.read();
    EXPECT_EQ(scene.materials[0].texel_scale, 0.25);
    EXPECT_EQ(scene.nodes[0].texel_scale, 3);
    EXPECT_EQ(note_count(scene, "texel_scale"), 0u);
}

TEST(ReadTexelScale, WhatIsNoScaleIsNoted) {
    Scene scene;
    const std::vector<Json> wrong{0, -1, "0.5", true, 1e9, 1e-9, Json::array({1})};
    for (const Json& value : wrong)
        EXPECT_EQ(read_texel_scale({{"extras", {{"texel_scale", value}}}}, "node 3", scene), 1) << value;
    EXPECT_EQ(note_count(scene, "texel_scale"), wrong.size());
    EXPECT_EQ(read_texel_scale({{"extras", "text"}}, "node 3", scene), 1);
}

}  // namespace
}  // namespace surimi
