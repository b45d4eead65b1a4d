// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf.h"

#include "tests/unit/square_glb.h"

#include <gtest/gtest.h>

#include <limits>

namespace surimi {
namespace {

using test::expect_near;
using test::Json;
using test::mentions;
using test::note_count;
using test::refusal;
using test::Square;

Vec3 face_normal(const Surface& s, size_t t) {
    const auto& c = s.triangles[t];
    return normalize_or(area_normal(s.positions[c[0]], s.positions[c[1]], s.positions[c[2]]), Vec3(0));
}

TEST(ReadGltf, MissingNormalsAreFlatAndVerticesUnshared) {
    const Scene scene = Square().read();
    ASSERT_EQ(scene.surfaces.size(), 1u);
    const Surface& s = scene.surfaces[0];
    EXPECT_EQ(s.name, "node_0");
    EXPECT_EQ(s.positions.size(), 6u);
    EXPECT_EQ(s.source_vertex, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(s.source_triangle, (std::vector<uint32_t>{0, 1}));
    for (const Vec3& normal : s.normals) expect_near(normal, Vec3(0, 0, 1));
}

TEST(ReadGltf, IndicesOfEveryWidth) {
    for (const int type : {5121, 5123, 5125}) {
        Square square;
        const int indices = type == 5121   ? square.add<uint8_t>({0, 1, 2, 0, 2, 3}, type, "SCALAR")
                            : type == 5123 ? square.add<uint16_t>({0, 1, 2, 0, 2, 3}, type, "SCALAR")
                                           : square.add<uint32_t>({0, 1, 2, 0, 2, 3}, type, "SCALAR");
        square.primitive["indices"] = indices;
        EXPECT_EQ(triangle_count(square.read()), 2u) << type;
    }
}

TEST(ReadGltf, WithoutIndicesVerticesAreInOrder) {
    Square square;
    square.primitive.erase("indices");
    square.primitive["attributes"]["POSITION"] = square.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const Scene scene = square.read();
    EXPECT_EQ(triangle_count(scene), 1u);
    EXPECT_EQ(note_count(scene, "left-over indices"), 1u);
}

TEST(ReadGltf, StripsAndFansKeepTheirFront) {
    for (const int mode : {5, 6}) {
        Square square;
        square.primitive["mode"] = mode;
        square.primitive["indices"] = mode == 5 ? square.add_indices({0, 1, 3, 2}) : square.add_indices({0, 1, 2, 3});
        const Scene scene = square.read();
        ASSERT_EQ(triangle_count(scene), 2u) << mode;
        for (size_t t = 0; t < 2; ++t) expect_near(face_normal(scene.surfaces[0], t), Vec3(0, 0, 1));
    }
}

TEST(ReadGltf, PointsAndLinesAreCountedAndSkipped) {
    Square square;
    const Json triangles = square.primitive;
    for (int mode = 0; mode < 4; ++mode) {
        Json line = triangles;
        line["mode"] = mode;
        square.json["meshes"][0]["primitives"].push_back(line);
    }
    const Scene scene = square.read();
    EXPECT_EQ(triangle_count(scene), 2u);
    EXPECT_EQ(note_count(scene, "points or lines"), 4u);
    EXPECT_EQ(scene.surfaces[0].name, "node_0/0");
}

TEST(ReadGltf, MirroredNodeKeepsTheFrontOutside) {
    Square square;
    square.primitive["attributes"]["NORMAL"] = square.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    square.json["nodes"][0]["scale"] = {-2, 1, 1};
    const Scene scene = square.read();
    for (size_t t = 0; t < 2; ++t) expect_near(face_normal(scene.surfaces[0], t), Vec3(0, 0, 1));
    for (const Vec3& normal : scene.surfaces[0].normals) expect_near(normal, Vec3(0, 0, 1));
}

TEST(ReadGltf, MirrorAlongTheNormalTurnsIt) {
    Square square;
    square.primitive["attributes"]["NORMAL"] = square.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    square.json["nodes"][0]["scale"] = {1, 1, -1};
    const Scene scene = square.read();
    expect_near(face_normal(scene.surfaces[0], 0), Vec3(0, 0, -1));
    expect_near(scene.surfaces[0].normals[0], Vec3(0, 0, -1));
}

TEST(ReadGltf, NormalsSurviveAFlatteningScale) {
    Square square;
    square.primitive["attributes"]["NORMAL"] = square.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    square.json["nodes"][0]["scale"] = {1, 1, 0};
    const Scene scene = square.read();
    EXPECT_EQ(triangle_count(scene), 2u);
    expect_near(scene.surfaces[0].normals[0], Vec3(0, 0, 1));
}

TEST(ReadGltf, ZeroScaleDropsEveryTriangle) {
    Square square;
    square.json["nodes"][0]["scale"] = {0, 0, 0};
    const Scene scene = square.read();
    EXPECT_TRUE(scene.surfaces.empty());
    EXPECT_EQ(note_count(scene, "zero-area"), 2u);
}

TEST(ReadGltf, DegenerateTrianglesAreDroppedAndTheOthersKeepTheirNumbers) {
    Square square;
    square.primitive["indices"] = square.add_indices({0, 0, 1, 0, 1, 2, 1, 2, 1, 0, 2, 3});
    const Scene scene = square.read();
    EXPECT_EQ(scene.surfaces[0].source_triangle, (std::vector<uint32_t>{1, 3}));
    EXPECT_EQ(note_count(scene, "zero-area"), 2u);
}

TEST(ReadGltf, NodesMultiplyDownTheTree) {
    Square square;
    square.json["nodes"] = {{{"children", {1}},
                             {"translation", {10, 0, 0}},
                             {"rotation", {0, 0, 0.70710678118654757, 0.70710678118654757}}},
                            {{"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 0, 0, 1}}}};
    const Scene scene = square.read();
    // (1, 0, 0) -> scaled and moved (3, 0, 0) -> turned by 90 degrees (0, 3, 0) -> moved (10, 3, 0)
    expect_near(scene.surfaces[0].positions[1], Vec3(10, 3, 0));
    EXPECT_EQ(scene.nodes[1].parent, 0);
}

TEST(ReadGltf, SharedMeshesMakeOneSurfaceForEachNode) {
    Square square;
    square.json["nodes"] = {{{"mesh", 0}, {"name", "left"}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
    square.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = square.read();
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(scene.surfaces[0].name, "left");
    EXPECT_EQ(scene.surfaces[1].name, "node_1");
    EXPECT_EQ(bounds(scene).high.x, 6);
}

TEST(ReadGltf, OnlyTheShownSceneMakesSurfaces) {
    Square square;
    square.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
    square.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    square.json["scene"] = 1;
    const Scene scene = square.read();
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(scene.surfaces[0].node, 1);
    EXPECT_FALSE(scene.nodes[0].is_in_scene);
    square.json.erase("scene");
    EXPECT_EQ(square.read().surfaces[0].node, 0);
    square.json.erase("scenes");
    EXPECT_EQ(square.read().surfaces.size(), 2u);
}

TEST(ReadGltf, BadNormalsAreRepaired) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    Square square;
    square.primitive["attributes"]["NORMAL"] = square.add_floats({0, 0, 5, 0, 0, 0, nan, 0, 1, 0, 0, 1}, "VEC3");
    const Scene scene = square.read();
    for (const Vec3& normal : scene.surfaces[0].normals) expect_near(normal, Vec3(0, 0, 1));
    EXPECT_EQ(note_count(scene, "renormalised"), 1u);
    EXPECT_EQ(note_count(scene, "replaced"), 2u);
}

TEST(ReadGltf, QuantisedAttributes) {
    Square square;
    square.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    square.primitive["attributes"] = {
        {"POSITION", square.add<uint16_t>({0, 0, 0, 65535, 0, 0, 65535, 65535, 0, 0, 65535, 0}, 5123, "VEC3")},
        {"TEXCOORD_0", square.add<uint16_t>({0, 0, 65535, 0, 65535, 65535, 0, 65535}, 5123, "VEC2")}};
    for (const int accessor : {2, 3}) square.json["accessors"][accessor]["normalized"] = true;
    square.json["nodes"][0]["scale"] = {4, 4, 4};
    const Scene scene = square.read();
    expect_near(scene.surfaces[0].positions[2], Vec3(4, 4, 0));
    EXPECT_EQ(scene.surfaces[0].uv_sets[0][2], Vec2(1, 1));
}

TEST(ReadGltf, SeveralUvSetsAndGaps) {
    Square square;
    square.primitive["attributes"]["TEXCOORD_1"] =
        square.add_floats({0, 0, 1, 0, 1, 1, 0, std::numeric_limits<float>::infinity()}, "VEC2");
    const Scene scene = square.read();
    ASSERT_EQ(scene.surfaces[0].uv_sets.size(), 2u);
    EXPECT_EQ(scene.surfaces[0].uv_sets[0][2], Vec2(0));
    EXPECT_EQ(scene.surfaces[0].uv_sets[1][2], Vec2(1, 1));
    EXPECT_EQ(note_count(scene, "missing UV sets"), 1u);
    EXPECT_EQ(note_count(scene, "not finite"), 1u);
}

TEST(ReadGltf, WrongBoundsAreIgnoredAndCounted) {
    Square square;
    square.json["accessors"][0]["min"] = {5, 5, 5};
    square.json["accessors"][0]["max"] = {6, 6, 6};
    const Scene scene = square.read();
    EXPECT_EQ(triangle_count(scene), 2u);
    EXPECT_EQ(note_count(scene, "wrong accessor bounds"), 1u);
}

TEST(ReadGltf, MorphTargetsAtTheirDefaultWeights) {
    Square square;
    square.primitive["targets"] = {{{"POSITION", square.add_floats({0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3")}}};
    square.json["meshes"][0]["weights"] = {0.5};
    expect_near(square.read().surfaces[0].positions[0], Vec3(0, 0, 1));
    square.json["nodes"][0]["weights"] = {1.0};
    const Scene scene = square.read();
    expect_near(scene.surfaces[0].positions[0], Vec3(0, 0, 2));
    EXPECT_EQ(note_count(scene, "morph targets"), 1u);
}

TEST(ReadGltf, SkinIgnoresTheNodeAndFollowsTheJoints) {
    Square square;
    square.primitive["attributes"]["JOINTS_0"] =
        square.add<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, "VEC4");
    square.primitive["attributes"]["WEIGHTS_0"] =
        square.add_floats({1, 0, 0, 0, .5f, .5f, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    const std::vector<float> moved_down{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
    std::vector<float> bind = moved_down;
    bind.insert(bind.end(), moved_down.begin(), moved_down.end());
    const int inverse_bind = square.add_floats(bind, "VEC4");  // 8 of VEC4; made 2 of MAT4:
    square.json["accessors"][inverse_bind]["type"] = "MAT4";
    square.json["accessors"][inverse_bind]["count"] = 2;
    square.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                            {{"translation", {0, 1, 0}}},
                            {{"translation", {0, 1, 8}}}};
    square.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverse_bind}}};
    square.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = square.read();
    const Surface& s = scene.surfaces[0];
    expect_near(s.positions[0], Vec3(0, 0, 0));  // joint 0: up and down again
    expect_near(s.positions[1], Vec3(1, 0, 4));  // half of joint 1's 8
    expect_near(s.positions[2], Vec3(1, 1, 8));
    EXPECT_EQ(note_count(scene, "skinned meshes"), 1u);
}

TEST(ReadGltf, JointOutOfRangeIsAnError) {
    Square square;
    square.primitive["attributes"]["JOINTS_0"] = square.add<uint8_t>(std::vector<uint8_t>(16, 9), 5121, "VEC4");
    square.primitive["attributes"]["WEIGHTS_0"] = square.add_floats(std::vector<float>(16, 0.25f), "VEC4");
    square.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}};
    square.json["skins"] = {{{"joints", {0}}}};
    EXPECT_TRUE(mentions(refusal(square.write(test::test_folder() / "joints.glb")), "names joint 9"));
}

TEST(ReadGltf, PositionsThatAreNotFiniteAreAnErrorWithPlace) {
    for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        Square square;
        square.json["meshes"][0]["name"] = "Chair";
        square.primitive["attributes"]["POSITION"] = square.add_floats({0, 0, 0, bad, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
        const std::string message = refusal(square.write(test::test_folder() / "infinite.glb"));
        for (const char* part : {"infinite.glb", "mesh 0 (Chair)", "primitive 0", "POSITION", "accessor 2", "vertex 1"})
            EXPECT_TRUE(mentions(message, part)) << part << " in " << message;
    }
}

TEST(ReadGltf, WorldPositionsThatOverflowAreAnError) {
    Square square;
    square.json["nodes"][0] = {{"children", {1}}, {"scale", {1e300, 1e300, 1e300}}};
    square.json["nodes"].push_back({{"mesh", 0}, {"scale", {1e300, 1e300, 1e300}}});
    EXPECT_TRUE(mentions(refusal(square.write(test::test_folder() / "overflow.glb")), "not finite in the world"));
}

TEST(ReadGltf, FilesWithSpacesAndEscapesAreFound) {
    const std::filesystem::path folder = test::test_folder();
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::ofstream(folder / "my data #1.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(positions.data()), 36);
    for (const char* uri : {"my data #1.bin", "my%20data%20%231.bin", "sub/../my%20data #1.bin"}) {
        std::filesystem::create_directories(folder / "sub");
        const Json json = {
            {"asset", {{"version", "2.0"}}},
            {"buffers", {{{"byteLength", 36}, {"uri", uri}}}},
            {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
            {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
            {"nodes", {{{"mesh", 0}}}}};
        std::ofstream(folder / "scene.gltf") << json.dump();
        EXPECT_EQ(triangle_count(read_gltf(folder / "scene.gltf")), 1u) << uri;
    }
}

TEST(ReadGltf, MissingBufferIsAnErrorThatNamesIt) {
    const std::filesystem::path path = test::test_folder() / "scene.gltf";
    std::ofstream(path) << R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"gone.bin"}]})";
    EXPECT_TRUE(mentions(refusal(path), "gone.bin"));
    std::ofstream(path) << R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"/etc/hostname"}]})";
    EXPECT_TRUE(mentions(refusal(path), "absolute"));
}

TEST(ReadGltf, RequiredExtensionsThatWeCannotReadAreNamedWithACommand) {
    Square square;
    square.json["extensionsRequired"] = {"EXT_unheard_of"};
    const std::string message = refusal(square.write(test::test_folder() / "required.glb"));
    EXPECT_TRUE(mentions(message, "EXT_unheard_of") && mentions(message, "npx @gltf-transform/cli")) << message;
    square.json["extensionsRequired"] = {"KHR_materials_sheen", "KHR_lights_punctual"};
    EXPECT_EQ(triangle_count(square.read()), 2u);
}

TEST(ReadGltf, CamerasInTheScene) {
    Square square;
    square.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"aspectRatio", 2.0}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 2}, {"znear", 1}}}}};
    square.json["nodes"].push_back({{"camera", 0}, {"name", "eye"}, {"translation", {1, 2, 3}}});
    square.json["nodes"].push_back({{"camera", 1}});
    square.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = square.read();
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_EQ(scene.cameras[0].yfov, 1.0);
    EXPECT_EQ(scene.cameras[0].aspect, 2.0);
    expect_near(Vec3(scene.cameras[0].to_world[3]), Vec3(1, 2, 3));
    EXPECT_EQ(note_count(scene, "not perspective"), 1u);
}

}  // namespace
}  // namespace surimi
