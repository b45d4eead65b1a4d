// SPDX-License-Identifier: Apache-2.0
// Broken files either load or are refused with an Error(scene) that names them; nothing else may happen.
#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "tests/unit/glb_builder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <random>

namespace surimi {
namespace {

using test::GlbBuilder;
using test::Json;

/// A valid file with something of everything: shared mesh, skin, morph target, sparse accessor, image,
/// camera.
GlbBuilder rich_scene() {
    GlbBuilder glb;
    const int positions = glb.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const int normals = glb.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int uvs = glb.add_floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    const int corners = glb.add_indices({0, 1, 2, 0, 2, 3});
    const int joints = glb.add<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, "VEC4");
    const int weights = glb.add_floats({1, 0, 0, 0, .5f, .5f, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int sparse = static_cast<int>(glb.json["accessors"].size());
    const std::vector<uint8_t> sparse_index{1, 0, 3, 0}, sparse_value(24, 0x3E);
    glb.json["accessors"].push_back(
        {{"componentType", 5126},
         {"count", 4},
         {"type", "VEC3"},
         {"sparse",
          {{"count", 2},
           {"indices", {{"bufferView", glb.add_view(sparse_index)}, {"componentType", 5123}}},
           {"values", {{"bufferView", glb.add_view(sparse_value)}}}}}});
    glb.json["meshes"] = {
        {{"name", "quad"},
         {"weights", {0.5}},
         {"primitives",
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
            {"indices", corners},
            {"material", 0},
            {"targets", {{{"POSITION", sparse}}}}}}}},
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}, {"mode", 5}}}}}};
    glb.json["materials"] = {
        {{"name", "Monitor_R"}, {"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}}};
    glb.json["textures"] = {{{"source", 0}}};
    glb.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    glb.json["nodes"] = {{{"name", "Monitor_R"}, {"mesh", 0}, {"children", {1, 2}}},
                         {{"mesh", 0}, {"scale", {-1, 2, 1}}, {"translation", {0, 0, 3}}},
                         {{"mesh", 1}, {"skin", 0}, {"camera", 0}}};
    glb.json["skins"] = {{{"joints", {0, 1}}}};
    glb.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    glb.json["scenes"] = {{{"nodes", {0}}}};
    glb.json["scene"] = 0;
    return glb;
}

std::vector<uint8_t> bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& path, const std::vector<uint8_t>& bytes) {
    std::filesystem::remove(path);  // file systems flush a file that is truncated and rewritten: 4 ms each
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// What everything after the reader relies on.
void expect_sound(const Scene& scene) {
    for (const Surface& s : scene.surfaces) {
        EXPECT_EQ(s.normals.size(), s.positions.size());
        EXPECT_EQ(s.source_vertex.size(), s.positions.size());
        EXPECT_EQ(s.source_triangle.size(), s.triangles.size());
        EXPECT_FALSE(s.triangles.empty());
        EXPECT_LT(s.material, static_cast<int>(scene.materials.size()));
        for (const auto& set : s.uv_sets) EXPECT_EQ(set.size(), s.positions.size());
        for (const Vec3& p : s.positions) EXPECT_TRUE(is_finite(p));
        for (const Vec3& n : s.normals) EXPECT_NEAR(glm::length(n), 1, 1e-9);
        for (const auto& t : s.triangles)
            for (const uint32_t v : t) EXPECT_LT(v, s.positions.size());
    }
}

/// The message of the refusal; empty when the file loads. Anything but these two fails the test.
std::string verdict(const std::filesystem::path& path) {
    try {
        Scene scene = read_gltf(path);
        expect_sound(scene);
        try {
            find_monitors(scene, {});
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::nothing_to_bake);
        }
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene) << error.what();
        EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
        return error.what();
    } catch (const std::exception& error) {
        ADD_FAILURE() << path << ": " << error.what();
    }
    return "";
}

TEST(BrokenFiles, TheSceneThatIsBrokenBelowLoads) {
    GlbBuilder glb = rich_scene();
    const std::filesystem::path path = glb.write(test::test_folder() / "whole.glb");
    EXPECT_EQ(verdict(path), "");
    EXPECT_EQ(triangle_count(read_gltf(path)), 6u);
}

/// One way to break the JSON of the rich scene, and a part of the refusal.
struct Breakage {
    const char* name;
    std::function<void(Json&)> apply;
    const char* refusal;
};

class BrokenJson : public testing::TestWithParam<Breakage> {};

TEST_P(BrokenJson, IsRefused) {
    GlbBuilder glb = rich_scene();
    GetParam().apply(glb.json);
    // The parameter's name instead of the test's, which has a slash.
    const auto folder = std::filesystem::temp_directory_path() / (std::string("surimi_broken_") + GetParam().name);
    std::filesystem::create_directories(folder);
    const std::string message = verdict(glb.write(folder / "broken.glb"));
    EXPECT_NE(message.find(GetParam().refusal), std::string::npos) << message;
    std::filesystem::remove_all(folder);
}

Json& primitive(Json& j) {
    return j["meshes"][0]["primitives"][0];
}

const Breakage breakages[] = {
    {"CountIsHuge", [](Json& j) { j["accessors"][0]["count"] = 4'000'000'000'000u; }, "do not fit"},
    {"CountIsBeyondDouble", [](Json& j) { j["accessors"][0]["count"] = 18446744073709551615u; }, "whole number"},
    {"CountIsNegative", [](Json& j) { j["accessors"][0]["count"] = -1; }, "whole number"},
    {"CountIsAFraction", [](Json& j) { j["accessors"][0]["count"] = 1.5; }, "whole number"},
    {"CountIsText", [](Json& j) { j["accessors"][0]["count"] = "4"; }, "whole number"},
    {"CountIsMissing", [](Json& j) { j["accessors"][0].erase("count"); }, "\"count\" is missing"},
    {"ViewlessCountIsHuge",
     [](Json& j) {
         j["accessors"][0].erase("bufferView");
         j["accessors"][0]["count"] = 4'000'000'000u;
     },
     "no buffer view"},
    {"OffsetIsNegative", [](Json& j) { j["bufferViews"][0]["byteOffset"] = -16; }, "whole number"},
    {"OffsetIsPastTheEnd", [](Json& j) { j["bufferViews"][0]["byteOffset"] = 1'000'000; }, "outside buffer"},
    {"OffsetWrapsAround", [](Json& j) { j["accessors"][0]["byteOffset"] = 9007199254740991u; }, "do not fit"},
    {"ViewIsTooLong", [](Json& j) { j["bufferViews"][0]["byteLength"] = 1'000'000; }, "outside buffer"},
    {"ViewOfNoBuffer", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; }, "\"buffer\" is 1"},
    {"StrideIsTooShort", [](Json& j) { j["bufferViews"][0]["byteStride"] = 8; }, "longer than the stride"},
    {"StrideIsOdd", [](Json& j) { j["bufferViews"][0]["byteStride"] = 13; }, "byteStride"},
    {"AccessorOfNoView", [](Json& j) { j["accessors"][0]["bufferView"] = 99; }, "\"bufferView\" is 99"},
    {"ComponentTypeIsUnknown", [](Json& j) { j["accessors"][0]["componentType"] = 5124; }, "componentType"},
    {"TypeIsUnknown", [](Json& j) { j["accessors"][0]["type"] = "VEC5"; }, "VEC5"},
    {"PositionsAreVec2", [](Json& j) { primitive(j)["attributes"]["POSITION"] = 2; }, "must be VEC3"},
    {"PositionOfNoAccessor", [](Json& j) { primitive(j)["attributes"]["POSITION"] = 99; }, "\"attributes\" is 99"},
    {"NormalsAreTooFew", [](Json& j) { j["accessors"][1]["count"] = 3; }, "but the primitive has 4 vertices"},
    {"IndexIsOutOfRange",
     [](Json& j) {
         j["accessors"][0]["count"] = 3;
         j["accessors"][1]["count"] = 3;
         j["accessors"][2]["count"] = 3;
         j["accessors"][6]["count"] = 3;
         j["accessors"][6].erase("sparse");
     },
     "index 5 is 3"},
    {"IndicesAreFloats", [](Json& j) { primitive(j)["indices"] = 0; }, "unsigned integer"},
    {"IndicesAreNegative", [](Json& j) { primitive(j)["indices"] = -1; }, "whole number"},
    {"ModeIsUnknown", [](Json& j) { primitive(j)["mode"] = 7; }, "\"mode\" is 7"},
    {"MaterialIsOutOfRange", [](Json& j) { primitive(j)["material"] = 1; }, "\"material\" is 1"},
    {"TextureIsOutOfRange", [](Json& j) { j["materials"][0]["emissiveTexture"]["index"] = 5; }, "\"index\" is 5"},
    {"ImageIsOutOfRange", [](Json& j) { j["textures"][0]["source"] = 5; }, "\"source\" is 5"},
    {"SparseIndexIsOutOfRange", [](Json& j) { j["accessors"][6]["count"] = 3; }, "sparse index 3"},
    {"SparseCountIsHuge", [](Json& j) { j["accessors"][6]["sparse"]["count"] = 4'000'000'000u; }, "2 GB"},
    {"SparseValuesAreMissing", [](Json& j) { j["accessors"][6]["sparse"].erase("values"); }, "\"values\" is missing"},
    {"SparseViewIsTooShort", [](Json& j) { j["accessors"][6]["sparse"]["values"]["byteOffset"] = 20; }, "do not fit"},
    {"NodeIsItsOwnChild",
     [](Json& j) {
         j["nodes"][1]["children"] = {1};
         j["nodes"][0].erase("children");
     },
     "its own ancestor"},
    {"NodesFormALoop",
     [](Json& j) {
         j["nodes"][0].erase("children");
         j["nodes"][1]["children"] = {2};
         j["nodes"][2]["children"] = {1};
     },
     "its own ancestor"},
    {"NodeHasTwoParents", [](Json& j) { j["nodes"][1]["children"] = {2}; }, "is a child of node 0 and of node 1"},
    {"ChildDoesNotExist", [](Json& j) { j["nodes"][1]["children"] = {9}; }, "\"children\" is 9"},
    {"NodeOfNoMesh", [](Json& j) { j["nodes"][1]["mesh"] = 9; }, "\"mesh\" is 9"},
    {"NodeOfNoSkin", [](Json& j) { j["nodes"][2]["skin"] = 9; }, "\"skin\" is 9"},
    {"NodeOfNoCamera", [](Json& j) { j["nodes"][2]["camera"] = 9; }, "\"camera\" is 9"},
    {"JointDoesNotExist",
     [](Json& j) {
         j["skins"][0]["joints"] = {0, 9};
     },
     "\"joints\" is 9"},
    {"TooFewJoints", [](Json& j) { j["skins"][0]["joints"] = {0}; }, "names joint 1"},
    {"InverseBindMatricesAreVectors", [](Json& j) { j["skins"][0]["inverseBindMatrices"] = 0; }, "MAT4"},
    {"MatrixIsTooShort",
     [](Json& j) {
         j["nodes"][1]["matrix"] = {1, 2, 3};
     },
     "must have 16 numbers"},
    {"ScaleIsText",
     [](Json& j) {
         j["nodes"][1]["scale"] = {"a", "b", "c"};
     },
     "list of numbers"},
    {"SceneIsOutOfRange", [](Json& j) { j["scene"] = 4; }, "\"scene\" is 4"},
    {"NodesAreAnObject", [](Json& j) { j["nodes"] = Json::object(); }, "must be a list"},
    {"MeshIsNull", [](Json& j) { j["meshes"][0] = nullptr; }, "must be an object"},
    {"PrimitivesAreMissing", [](Json& j) { j["meshes"][0].erase("primitives"); }, "\"primitives\" is missing"},
    {"AssetIsMissing", [](Json& j) { j.erase("asset"); }, "\"asset\" is missing"},
    {"VersionIsOne", [](Json& j) { j["asset"]["version"] = "1.0"; }, "only glTF 2"},
    {"BufferIsMissing", [](Json& j) { j.erase("bufferViews"); }, "\"bufferView\""},
    {"ExtensionIsRequiredAndUnknown", [](Json& j) { j["extensionsRequired"] = {"EXT_unheard_of"}; }, "EXT_unheard_of"},
    {"ExtensionsAreNumbers",
     [](Json& j) {
         j["extensionsUsed"] = {1, 2};
     },
     "must be text"},
    {"DracoWithoutData",
     [](Json& j) {
         primitive(j)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                                     {"attributes", {{"POSITION", 0}}}};
     },
     "draco"},
    {"MeshoptIsNotAnObject", [](Json& j) { j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = 3; }, ""},
    {"MeshoptWithoutData",
     [](Json& j) {
         j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0}, {"byteLength", 8}, {"byteStride", 12}, {"count", 4}, {"mode", "ATTRIBUTES"}};
     },
     "damaged"},
};

INSTANTIATE_TEST_SUITE_P(BrokenFiles, BrokenJson, testing::ValuesIn(breakages),
                         [](const testing::TestParamInfo<Breakage>& breakage) {
                             return std::string(breakage.param.name);
                         });

std::string verdict_of_text(const std::string& text) {
    const std::filesystem::path path = test::test_folder() / "text.gltf";
    std::ofstream(path) << text;
    return verdict(path);
}

TEST(BrokenFiles, EmptyFile) {
    EXPECT_NE(verdict_of_text(""), "");
}
TEST(BrokenFiles, NotJson) {
    EXPECT_NE(verdict_of_text("solid cube"), "");
}
TEST(BrokenFiles, JsonThatIsNoObject) {
    EXPECT_NE(verdict_of_text("[1, 2, 3]"), "");
}
TEST(BrokenFiles, NumberBeyondDouble) {
    EXPECT_NE(verdict_of_text(R"({"x":1e999})"), "");
}
TEST(BrokenFiles, BytesThatAreNoUtf8) {
    EXPECT_NE(verdict_of_text("{\"asset\":{\"version\":\"\xFF\xFE\"}}"), "");
}
TEST(BrokenFiles, NestedTooDeep) {
    const std::string deep(1'000'000, '[');
    EXPECT_NE(verdict_of_text(deep).find("nested"), std::string::npos);
    EXPECT_NE(verdict_of_text("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep + std::string(1'000'000, ']') + "}")
                  .find("nested"),
              std::string::npos);
}
TEST(BrokenFiles, BracketsInTextAreNotNesting) {
    EXPECT_EQ(verdict_of_text("{\"asset\":{\"version\":\"2.0\",\"generator\":\"\\\"" + std::string(1000, '[') + "\"}}"),
              "");
}
TEST(BrokenFiles, ALongChainOfNodesIsNoRecursion) {
    Json json{{"asset", {{"version", "2.0"}}}};
    for (int i = 0; i < 100'000; ++i)
        json["nodes"].push_back(i + 1 < 100'000 ? Json{{"children", {i + 1}}} : Json::object());
    EXPECT_EQ(verdict_of_text(json.dump()), "");
}
TEST(BrokenFiles, MissingFileAndFolder) {
    const std::filesystem::path folder = test::test_folder();
    EXPECT_NE(verdict(folder / "gone.glb"), "");
    std::filesystem::create_directories(folder / "folder.glb");
    EXPECT_NE(verdict(folder / "folder.glb"), "");
}
TEST(BrokenFiles, BufferInTheUriIsTruncatedOrMalformed) {
    const auto with_uri = [](const std::string& uri) {
        return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri + "\"}]}";
    };
    EXPECT_NE(verdict_of_text(with_uri("data:application/octet-stream;base64,AAAA")).find("truncated"),
              std::string::npos);
    EXPECT_NE(verdict_of_text(with_uri("data:application/octet-stream;base64,A!AA")).find("malformed"),
              std::string::npos);
    EXPECT_NE(verdict_of_text(with_uri("data:application/octet-stream")).find("malformed"), std::string::npos);
    EXPECT_NE(verdict_of_text(with_uri("https://example.com/a.bin")).find("not a file"), std::string::npos);
    EXPECT_NE(verdict_of_text(with_uri("")).find("not a file"), std::string::npos);
}

TEST(BrokenGlb, EveryTruncationIsRefused) {
    GlbBuilder glb = rich_scene();
    const std::filesystem::path path = glb.write(test::test_folder() / "cut.glb");
    const std::vector<uint8_t> whole = bytes_of(path);
    for (size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 37) {
        write_bytes(path, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
        EXPECT_NE(verdict(path), "") << size;
    }
}

TEST(BrokenGlb, ChunkSizesAndHeader) {
    GlbBuilder glb = rich_scene();
    const std::filesystem::path path = glb.write(test::test_folder() / "chunk.glb");
    const std::vector<uint8_t> whole = bytes_of(path);
    for (const size_t offset : {4u, 8u, 12u, 16u})
        for (const uint8_t value : {uint8_t{0}, uint8_t{0x7F}, uint8_t{0xFF}}) {
            std::vector<uint8_t> bytes = whole;
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), 4, value);
            write_bytes(path, bytes);
            EXPECT_NE(verdict(path), "") << offset << " " << int{value};
        }
}

TEST(BrokenGlb, EmptyBinaryChunk) {
    std::vector<uint8_t> bytes;
    const std::string json = R"({"asset":{"version":"2.0"}} )";
    for (const size_t word : {size_t{0x46546C67}, size_t{2}, 28 + json.size(), json.size(), size_t{0x4E4F534A}})
        test::append_u32(bytes, word);
    bytes.insert(bytes.end(), json.begin(), json.end());
    for (const size_t word : {size_t{0}, size_t{0x004E4942}}) test::append_u32(bytes, word);
    const std::filesystem::path path = test::test_folder() / "empty.glb";
    write_bytes(path, bytes);
    EXPECT_EQ(verdict(path), "");
}

TEST(BrokenGlb, FlippedAndRemovedBytesNeverCrash) {
    GlbBuilder glb = rich_scene();
    const std::filesystem::path path = glb.write(test::test_folder() / "fuzz.glb");
    const std::vector<uint8_t> whole = bytes_of(path);
    std::mt19937 random(1);  // the same files every time
    size_t refused = 0;
    constexpr size_t mutations = 4000;
    for (size_t m = 0; m < mutations; ++m) {
        std::vector<uint8_t> bytes = whole;
        for (auto flips = 1 + random() % 3; flips > 0; --flips)
            bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
        if (m % 8 == 0) bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size()));
        write_bytes(path, bytes);
        refused += verdict(path).empty() ? 0 : 1;
        if (HasFailure()) FAIL() << "mutation " << m << " is kept in " << path;
    }
    EXPECT_GT(refused, mutations / 10);
    EXPECT_LT(refused, mutations);
}

TEST(BrokenCorpus, EveryFileLoadsOrIsRefused) {
    const char* scenes = std::getenv("SURIMI_SCENES");
    if (scenes == nullptr || *scenes == '\0')
        GTEST_SKIP() << "SURIMI_SCENES does not name a folder of scenes; the cases above stand for them";
    size_t files = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(scenes) / "nasty-broken-corpus")) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".gltf" && ending != ".glb") continue;
        ++files;
        SCOPED_TRACE(entry.path().string());
        verdict(entry.path());
    }
    EXPECT_GT(files, 0u) << "no .gltf or .glb below " << scenes;
}

}  // namespace
}  // namespace surimi
