// SPDX-License-Identifier: Apache-2.0
#include "baked_file.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace surimi::test {
namespace {

TEST(BakedGlb, VerticesStaySharedWhereEachHasOneUv) {
    QuadFile file;
    const Baked baked(file, joined_atlas);
    const Json& primitive = baked.file.primitive(0);
    EXPECT_EQ(primitive["attributes"]["POSITION"], file.position);
    EXPECT_EQ(primitive["attributes"]["NORMAL"], file.normal);
    EXPECT_EQ(primitive["indices"], file.index);
    EXPECT_EQ(baked.file.json["accessors"].size(), 4);
    EXPECT_EQ(baked.file.values<float>(primitive["attributes"]["TEXCOORD_1"]),
              (std::vector<float>{0, 0, 1 / 4096.0f, 0, 2 / 4096.0f, 0, 3 / 4096.0f, 0}));
}

TEST(BakedGlb, SplitVerticesCarryAllTheirAttributes) {
    QuadFile file;
    Json& primitive = file.first_primitive();
    primitive["attributes"]["COLOR_0"] =
        file.add<uint8_t>({1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 0}, 5121, "VEC4");
    file.json["accessors"].back()["normalized"] = true;
    primitive["attributes"]["_WEAR"] = file.add<uint16_t>({100, 0, 200, 0, 300, 0, 400, 0}, 5123, "VEC2");
    primitive["targets"] = {{{"POSITION", file.add_floats({9, 8, 7, 6, 5, 4, 3, 2, 1, 0, -1, -2}, "VEC3")}}};
    file.json["accessors"].back()["name"] = "bend";
    file.json["accessors"].back()["min"] = {0, -1, -2};
    file.json["accessors"].back()["max"] = {9, 8, 7};
    const GlbFile before([&] {
        file.write(test_folder() / "before.glb");
        std::ifstream stream(std::filesystem::temp_directory_path() /
                                 "surimi_BakedGlb_SplitVerticesCarryAllTheirAttributes" / "before.glb",
                             std::ios::binary);
        return std::vector<uint8_t>(std::istreambuf_iterator<char>(stream), {});
    }());
    const Baked baked(file, scattered_atlas);
    const Json& after = baked.file.primitive(0);
    EXPECT_EQ(baked.file.values<float>(after["attributes"]["POSITION"]).size(), 6 * 3);
    int compared = 0;
    for (const auto& [name, accessor] : primitive["attributes"].items()) {
        EXPECT_EQ(at_corners(baked.file, after, after["attributes"][name]), at_corners(before, primitive, accessor));
        ++compared;
    }
    EXPECT_EQ(compared, 4);
    const Json& bend = after["targets"][0]["POSITION"];
    EXPECT_EQ(at_corners(baked.file, after, bend), at_corners(before, primitive, primitive["targets"][0]["POSITION"]));
    EXPECT_EQ(baked.file.json["accessors"][bend.get<size_t>()]["name"], "bend");
    EXPECT_EQ(baked.file.json["accessors"][bend.get<size_t>()]["max"], Json({9, 8, 7}));
    EXPECT_EQ(baked.file.json["accessors"][after["attributes"]["COLOR_0"].get<size_t>()]["normalized"], true);
}

TEST(BakedGlb, TheAtlasComesBack) {
    QuadFile file;
    file.add_node({{"name", "Mirrored"}, {"mesh", 0}, {"scale", {-1, 1, 1}}});
    for (const MakeAtlas& make_atlas : {MakeAtlas(scattered_atlas), MakeAtlas(joined_atlas)}) {
        const Baked baked(file, make_atlas);
        const Scene back = read_gltf(baked.write(baked.scene.path.parent_path() / "baked.glb"));
        ASSERT_EQ(back.surfaces.size(), 2u);
        for (size_t s = 0; s < 2; ++s)
            for (size_t t = 0; t < 2; ++t)
                for (size_t k = 0; k < 3; ++k) {
                    const uint32_t vertex = back.surfaces[s].triangles[t][k];
                    const uint32_t old = baked.scene.surfaces[s].triangles[t][k];
                    EXPECT_EQ(Vec2f(back.surfaces[s].uv_sets[1][vertex]), baked.atlas.surfaces[s].uv[t][k]);
                    EXPECT_EQ(back.surfaces[s].positions[vertex], baked.scene.surfaces[s].positions[old]);
                }
    }
}

TEST(BakedGlb, MirroredNodesKeepTheWindingOfTheFile) {
    QuadFile file;
    file.json["nodes"][0]["scale"] = {-1, 1, 1};
    const Baked baked(file, joined_atlas);
    EXPECT_EQ(baked.file.corners(baked.file.primitive(0)), (std::vector<size_t>{0, 1, 2, 0, 2, 3}));
}

TEST(BakedGlb, EveryInstanceHasItsOwnMesh) {
    QuadFile file;
    file.json["meshes"][0]["name"] = "Quad";
    file.json["meshes"][0]["extras"] = {{"maker", "me"}};
    file.add_node({{"name", "Second"}, {"mesh", 0}, {"translation", {2, 0, 0}}});
    file.json["nodes"].push_back({{"name", "Unseen"}, {"mesh", 0}});  // in no scene
    const Baked baked(file, joined_atlas);
    std::set<size_t> meshes;
    for (size_t n = 0; n < 3; ++n) meshes.insert(baked.file.json["nodes"][n]["mesh"].get<size_t>());
    EXPECT_EQ(meshes.size(), 3u);
    EXPECT_EQ(baked.file.json["meshes"].size(), 3);
    for (const Json& mesh : baked.file.json["meshes"]) {
        EXPECT_EQ(mesh["name"], "Quad");
        EXPECT_EQ(mesh["extras"]["maker"], "me");
        EXPECT_EQ(mesh["primitives"][0]["attributes"]["POSITION"], file.position) << "data is shared";
    }
    EXPECT_EQ(baked.file.primitive(2), file.first_primitive()) << "what is not shown is not touched";
    EXPECT_NE(baked.file.primitive(0)["attributes"]["TEXCOORD_1"], baked.file.primitive(1)["attributes"]["TEXCOORD_1"]);
}

TEST(BakedGlb, SplitInstancesAllReadTheSource) {
    QuadFile file;
    file.add_node({{"name", "Second"}, {"mesh", 0}});
    const Baked baked(file, scattered_atlas);
    const auto first =
        at_corners(baked.file, baked.file.primitive(0), baked.file.primitive(0)["attributes"]["POSITION"]);
    const auto second =
        at_corners(baked.file, baked.file.primitive(1), baked.file.primitive(1)["attributes"]["POSITION"]);
    EXPECT_EQ(first, second);
    EXPECT_EQ(first.size(), 6u);
}

TEST(BakedGlb, StripsFansAndListsWithoutIndicesBecomeIndexedLists) {
    for (const int mode : {4, 5, 6}) {
        QuadFile file;
        file.first_primitive().erase("indices");
        file.first_primitive()["mode"] = mode;
        const Baked baked(file, joined_atlas);
        const Json& primitive = baked.file.primitive(0);
        EXPECT_EQ(primitive.value("mode", 4), 4);
        const std::vector<std::vector<size_t>> expected{{0, 1, 2}, {0, 1, 2, 1, 3, 2}, {1, 2, 0, 2, 3, 0}};
        EXPECT_EQ(baked.file.corners(primitive), expected[static_cast<size_t>(mode - 4)]);
    }
}

TEST(BakedGlb, PointsAndLinesStay) {
    QuadFile file;
    Json points = file.primitive();
    points["mode"] = 0;
    file.json["meshes"][0]["primitives"].push_back(points);
    const Baked baked(file, scattered_atlas);
    EXPECT_EQ(baked.file.primitive(0, 1), points);
    EXPECT_EQ(baked.file.values<float>(baked.file.primitive(0, 1)["attributes"]["POSITION"]), quad_positions);
}

TEST(BakedGlb, TrianglesWithoutAreaStayAndAreMapped) {
    QuadFile file;
    file.first_primitive()["indices"] = file.add_indices({0, 0, 1, 0, 1, 2, 3, 3, 3, 0, 2, 3});
    const Baked baked(file, scattered_atlas);
    ASSERT_EQ(baked.scene.surfaces[0].triangles.size(), 2u);
    const Json& primitive = baked.file.primitive(0);
    const auto positions = at_corners(baked.file, primitive, primitive["attributes"]["POSITION"]);
    ASSERT_EQ(positions.size(), 12u);
    EXPECT_EQ(positions[0], positions[1]);
    EXPECT_EQ(positions[6], positions[8]);
    const auto uv = at_corners(baked.file, primitive, primitive["attributes"]["TEXCOORD_1"]);
    for (size_t t = 0; t < 12; t += 3)
        EXPECT_FALSE(uv[t] == uv[t + 1] && uv[t + 1] == uv[t + 2]) << "triangle " << t / 3 << " looks unmapped";
}

TEST(BakedGlb, VertexNumbersTakeTwoBytesWhileTheyFit) {
    for (const size_t triangles : {size_t{21844}, size_t{21845}}) {
        QuadFile file;
        std::vector<float> positions;
        for (size_t t = 0; t < triangles; ++t)
            positions.insert(positions.end(), {0, 0, float(t), 1, 0, float(t), 0, 1, float(t)});
        file.first_primitive() = {{"attributes", {{"POSITION", file.add_floats(positions, "VEC3")}}}};
        const Baked baked(file, joined_atlas);
        const Json& accessor = baked.file.json["accessors"][baked.file.primitive(0)["indices"].get<size_t>()];
        EXPECT_EQ(accessor["componentType"], triangles == 21844 ? 5123 : 5125);
    }
}

TEST(BakedGlb, AMissingFirstSetPointsToTheMap) {
    QuadFile file;
    const Baked baked(file, scattered_atlas);
    const Json& attributes = baked.file.primitive(0)["attributes"];
    EXPECT_EQ(attributes["TEXCOORD_0"], attributes["TEXCOORD_1"]);
}

TEST(BakedGlb, ASecondSetThatNobodyReadsIsReplaced) {
    QuadFile file;
    file.first_primitive()["attributes"]["TEXCOORD_0"] = file.add_floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    file.first_primitive()["attributes"]["TEXCOORD_1"] = file.add_floats({0, 0, 9, 0, 9, 9, 0, 9}, "VEC2");
    const Baked baked(file, joined_atlas);
    EXPECT_EQ(baked.file.json["accessors"].size(), 5);
    EXPECT_FALSE(baked.file.primitive(0)["attributes"].contains("TEXCOORD_2"));
}

TEST(BakedGlb, UvsThatAreThereAlreadyStay) {
    QuadFile file;
    Json& attributes = file.first_primitive()["attributes"];
    attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"] = file.add_floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    const Baked baked(file, [](const Scene& scene) {
        Atlas atlas = joined_atlas(scene);
        for (size_t t = 0; t < 2; ++t)
            for (size_t k = 0; k < 3; ++k)
                atlas.surfaces[0].uv[t][k] = Vec2f(scene.surfaces[0].uv_sets[1][scene.surfaces[0].triangles[t][k]]);
        return atlas;
    });
    Json expected = file.first_primitive();
    expected["material"] = 0;
    EXPECT_EQ(baked.file.primitive(0), expected);
    EXPECT_EQ(baked.file.json["accessors"], file.json["accessors"]);
}

TEST(BakedGlb, EverythingElseStays) {
    QuadFile file;
    Json& json = file.json;
    const Json extras{{"list", Json::array()}, {"nothing", nullptr}, {"big", 9007199254740993}, {"tenth", 0.1}};
    const Json unknown{{"ACME_thing", {{"deep", {{"empty", Json::object()}}}}}};
    json["extras"] = json["asset"]["extras"] = json["scenes"][0]["extras"] = json["nodes"][0]["extras"] = extras;
    json["extensions"] = json["nodes"][0]["extensions"] = file.first_primitive()["extensions"] = unknown;
    json["accessors"][0]["extras"] = json["meshes"][0]["extras"] = extras;
    json["extensionsUsed"] = {"ACME_thing"};
    json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}, {"extras", extras}}};
    file.add_node({{"name", "Eye"}, {"camera", 0}});
    json["images"] = {
        {{"name", "kept"}, {"mimeType", "image/png"}, {"bufferView", file.add_view(png)}, {"extras", extras}}};
    json["samplers"] = {{{"magFilter", 9728}, {"extras", extras}}};
    json["textures"] = {{{"sampler", 0}, {"source", 0}, {"extras", extras}}};
    const int times = file.add_floats({0, 1}, "SCALAR");
    json["animations"] = {{{"samplers", {{{"input", times}, {"output", file.add_floats({0, 0, 0, 1, 1, 1}, "VEC3")}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
                           {"extras", extras}}};
    json["accessors"][static_cast<size_t>(times)]["min"] = {0};
    json["accessors"][static_cast<size_t>(times)]["max"] = {1};
    const Baked baked(file, scattered_atlas);
    Json after = baked.file.json;
    for (const char* key : {"extras", "asset", "scenes", "scene", "nodes", "extensions", "cameras", "animations"})
        EXPECT_EQ(after[key], json[key]) << key;
    for (const char* key : {"images", "samplers", "textures"}) EXPECT_EQ(after[key][0], json[key][0]) << key;
    EXPECT_EQ(baked.file.view(after["images"][0]["bufferView"].get<size_t>()), png);
    EXPECT_EQ(after["accessors"][0]["extras"], extras);
    EXPECT_EQ(after["meshes"][0]["extras"], extras);
    EXPECT_EQ(baked.file.primitive(0)["extensions"], unknown);
    EXPECT_EQ(baked.file.values<float>(times), (std::vector<float>{0, 1}));
    EXPECT_EQ(after["extensionsUsed"], Json({"ACME_thing", "KHR_materials_clearcoat"}));
}

TEST(BakedGlb, WhatUnknownExtensionsMayNameKeepsItsPlace) {
    QuadFile file;
    file.json["nodes"][0]["extensions"] = {{"ACME_points", {{"positions", file.position}}}};
    const Baked baked(file, scattered_atlas);
    EXPECT_EQ(baked.file.values<float>(file.position), quad_positions);
    EXPECT_NE(baked.file.primitive(0)["attributes"]["POSITION"], file.position);
}

TEST(BakedGlb, ImagesOutsideTheFileMoveIn) {
    const auto folder = test_folder();
    std::ofstream(folder / "a b.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    QuadFile file;
    file.json["images"] = {{{"uri", "a%20b.png"}, {"name", "file"}}, {{"uri", "data:image/png;base64," + png_base64}}};
    const Baked baked(file.write(folder / "room.glb"), joined_atlas);
    for (size_t i = 0; i < 2; ++i) {
        const Json& image = baked.file.json["images"][i];
        EXPECT_FALSE(image.contains("uri"));
        EXPECT_EQ(image["mimeType"], "image/png");
        EXPECT_EQ(baked.file.view(image["bufferView"].get<size_t>()), png);
    }
    EXPECT_EQ(baked.file.json["images"][0]["name"], "file");
}

TEST(BakedGlb, SparseAttributesBecomePlainWhenTheyAreSplit) {
    QuadFile file;
    Json& accessor = file.json["accessors"][static_cast<size_t>(file.position)];
    const std::vector<uint8_t> which{3, 0};
    std::vector<uint8_t> value(12);
    const std::array<float, 3> moved{0, 2, 0};
    std::memcpy(value.data(), moved.data(), 12);
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", file.add_view(which)}, {"componentType", 5121}}},
                          {"values", {{"bufferView", file.add_view(value)}}}};
    accessor["max"] = {1, 2, 0};
    const Baked baked(file, scattered_atlas);
    const Json& primitive = baked.file.primitive(0);
    const auto corners = at_corners(baked.file, primitive, primitive["attributes"]["POSITION"]);
    EXPECT_EQ(corners[5], value);
    EXPECT_EQ(baked.file.json["accessors"][primitive["attributes"]["POSITION"].get<size_t>()]["max"], Json({1, 2, 0}));
}

TEST(BakedGlb, WrongBoundsAreCorrected) {
    QuadFile file;
    file.json["accessors"][0]["max"] = {5, 5, 5};
    const Baked baked(file, joined_atlas);
    EXPECT_EQ(baked.file.json["accessors"][0]["max"], Json({1, 1, 0}));
}

TEST(BakedGlb, SameInputSameBytes) {
    QuadFile file;
    file.add_node({{"name", "Second"}, {"mesh", 0}});
    const Baked baked(file, scattered_atlas);
    EXPECT_EQ(make_baked_glb(baked.scene, baked.atlas, map_of_screen), baked.bytes);
}

}  // namespace
}  // namespace surimi::test
