// SPDX-License-Identifier: Apache-2.0
// Encodes with the libraries, reads with ours.
#include "runtime/scene/compressed.h"

#include "tests/unit/square_glb.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace surimi {
namespace {

using test::expect_near;
using test::Json;
using test::mentions;
using test::refusal;
using test::Square;

/// The square's two triangles, compressed with Draco.
std::vector<uint8_t> draco_square() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const std::array<std::array<float, 3>, 4> corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), corners[0].data(), corners[1].data(), corners[2].data());
    builder.SetAttributeValuesForFace(id, draco::FaceIndex(1), corners[0].data(), corners[2].data(), corners[3].data());
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const auto* bytes = reinterpret_cast<const uint8_t*>(buffer.data());
    return {bytes, bytes + buffer.size()};
}

struct DracoSquare : Square {
    explicit DracoSquare(const std::vector<uint8_t>& compressed = draco_square()) {
        const int view = add_view(compressed);
        for (Json& accessor : json["accessors"]) accessor.erase("bufferView");
        json["extensionsRequired"] = json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
        primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                                 {"attributes", {{"POSITION", 0}}}};
    }
};

TEST(DecodeDraco, GivesTheSameSquare) {
    const Scene scene = DracoSquare().read();
    ASSERT_EQ(triangle_count(scene), 2u);
    const Bounds box = bounds(scene);
    expect_near(box.low, Vec3(0), 1.0 / (1 << 14));
    expect_near(box.high, Vec3(1, 1, 0), 1.0 / (1 << 14));
    for (const Vec3& normal : scene.surfaces[0].normals) expect_near(normal, Vec3(0, 0, 1), 1e-3);
}

TEST(DecodeDraco, LeavesNoTraceInTheModel) {
    DracoSquare square;
    const GltfDocument document = load_document(square.write(test::test_folder() / "draco.glb"));
    EXPECT_TRUE(document.model.extensionsRequired.empty());
    EXPECT_TRUE(document.model.meshes[0].primitives[0].extensions.empty());
    EXPECT_EQ(document.model.accessors[static_cast<size_t>(document.model.meshes[0].primitives[0].indices)].count, 6u);
}

TEST(DecodeDraco, DamagedDataIsAnErrorOrHarmless) {
    const std::vector<uint8_t> whole = draco_square();
    size_t refused = 0;
    for (size_t i = 0; i < whole.size(); ++i) {
        std::vector<uint8_t> damaged = whole;
        damaged[i] ^= 0xFF;
        DracoSquare square(damaged);
        refused += refusal(square.write(test::test_folder() / "damaged.glb")).empty() ? 0 : 1;
        DracoSquare shorter(std::vector<uint8_t>(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(i)));
        refused += refusal(shorter.write(test::test_folder() / "damaged.glb")).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, whole.size());
}

TEST(DecodeDraco, WrongReferencesAreErrors) {
    for (const Json& wrong : {Json{{"bufferView", 99}, {"attributes", {{"POSITION", 0}}}},
                              Json{{"bufferView", 2}, {"attributes", {{"POSITION", 5}}}}, Json{{"bufferView", 2}},
                              Json{{"bufferView", -1}, {"attributes", Json::object()}}}) {
        DracoSquare square;
        square.primitive["extensions"]["KHR_draco_mesh_compression"] = wrong;
        EXPECT_TRUE(mentions(refusal(square.write(test::test_folder() / "wrong.glb")), "KHR_draco_mesh_compression"))
            << wrong.dump();
    }
}

/// The square with both views compressed with meshopt, and a second, empty buffer for the views themselves.
struct MeshoptSquare : Square {
    Json& vertices;
    Json& indices;

    explicit MeshoptSquare(size_t cut = 0)
        : vertices((compress(cut), json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"])),
          indices(json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]) {}

    void compress(size_t cut) {
        const std::vector<float> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        std::vector<uint8_t> bytes(meshopt_encodeVertexBufferBound(4, 12));
        bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), positions.data(), 4, 12));
        describe(0, bytes, {{"mode", "ATTRIBUTES"}, {"byteStride", 12}, {"count", 4}}, cut);
        const std::vector<unsigned int> corners{0, 1, 2, 0, 2, 3};
        bytes.resize(meshopt_encodeIndexBufferBound(6, 4));
        bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), 6));
        describe(1, bytes, {{"mode", "TRIANGLES"}, {"byteStride", 2}, {"count", 6}}, cut);
        json["extensionsRequired"] = json["extensionsUsed"] = {"EXT_meshopt_compression"};
    }

    /// Moves the stream into an extension of view `v`; the view itself points at a buffer that is not there.
    void describe(size_t v, std::vector<uint8_t> bytes, Json extension, size_t cut) {
        bytes.resize(bytes.size() - std::min(cut, bytes.size()));
        const Json stream = json["bufferViews"][static_cast<size_t>(add_view(bytes))];
        extension["buffer"] = 0;
        extension["byteOffset"] = stream["byteOffset"];
        extension["byteLength"] = bytes.size();
        Json& view = json["bufferViews"][v];
        view["buffer"] = 1;
        view["byteOffset"] = 0;
        view["extensions"]["EXT_meshopt_compression"] = extension;
    }

    /// GlbBuilder knows one buffer only, so the second is added to the file's text.
    std::filesystem::path write_both() {
        const std::filesystem::path path = write(test::test_folder() / "meshopt.glb");
        std::ifstream in(path, std::ios::binary);
        std::vector<uint8_t> file((std::istreambuf_iterator<char>(in)), {});
        const test::GlbFile parts(file);
        Json text = parts.json;
        text["buffers"].push_back({{"byteLength", 64}});
        std::string padded = text.dump();
        padded.resize((padded.size() + 3) / 4 * 4, ' ');
        const size_t old_size = file[12] + 256u * file[13] + 65536u * file[14];
        std::vector<uint8_t> result;
        for (const size_t word :
             {size_t{0x46546C67}, size_t{2}, file.size() - old_size + padded.size(), padded.size(), size_t{0x4E4F534A}})
            test::append_u32(result, word);
        result.insert(result.end(), padded.begin(), padded.end());
        result.insert(result.end(), file.begin() + 20 + static_cast<std::ptrdiff_t>(old_size), file.end());
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(result.data()), static_cast<std::streamsize>(result.size()));
        return path;
    }
};

TEST(DecodeMeshopt, GivesTheSameSquareWithoutAFallback) {
    const Scene scene = read_gltf(MeshoptSquare().write_both());
    ASSERT_EQ(triangle_count(scene), 2u);
    expect_near(bounds(scene).high, Vec3(1, 1, 0), 0);
    for (const Vec3& normal : scene.surfaces[0].normals) expect_near(normal, Vec3(0, 0, 1), 0);
}

TEST(DecodeMeshopt, LeavesNoTraceInTheModel) {
    const GltfDocument document = load_document(MeshoptSquare().write_both());
    EXPECT_TRUE(document.model.extensionsRequired.empty() && document.model.extensionsUsed.empty());
    for (const tinygltf::BufferView& view : document.model.bufferViews) EXPECT_TRUE(view.extensions.empty());
}

TEST(DecodeMeshopt, FiltersAreApplied) {
    MeshoptSquare square;
    const std::vector<float> positions{0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    std::vector<uint32_t> filtered(12);
    meshopt_encodeFilterExp(filtered.data(), 4, 12, 15, positions.data());
    std::vector<uint8_t> bytes(meshopt_encodeVertexBufferBound(4, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), filtered.data(), 4, 12));
    square.describe(0, bytes, {{"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}, {"byteStride", 12}, {"count", 4}}, 0);
    expect_near(bounds(read_gltf(square.write_both())).high, Vec3(4, 4, 0), 0);
}

TEST(DecodeMeshopt, TruncatedStreamsAreErrors) {
    for (size_t cut = 1; cut < 40; ++cut)
        EXPECT_TRUE(mentions(refusal(MeshoptSquare(cut).write_both()), "EXT_meshopt_compression")) << cut;
}

TEST(DecodeMeshopt, SillyDescriptionsAreErrors) {
    const std::vector<std::pair<const char*, Json>> wrong{{"count", 4'000'000'000u},
                                                          {"count", -4},
                                                          {"count", 2'000'000'000},
                                                          {"count", 1},
                                                          {"byteStride", 7},
                                                          {"byteStride", 0},
                                                          {"byteStride", 1024},
                                                          {"mode", "ROUND"},
                                                          {"mode", 3},
                                                          {"filter", "BLUR"},
                                                          {"filter", "QUATERNION"},
                                                          {"buffer", 9},
                                                          {"byteOffset", 1'000'000},
                                                          {"byteLength", 1'000'000},
                                                          {"byteLength", -1}};
    for (const auto& [key, value] : wrong) {
        MeshoptSquare square;
        square.vertices[key] = value;
        EXPECT_TRUE(mentions(refusal(square.write_both()), "EXT_meshopt_compression")) << key << " " << value.dump();
    }
    MeshoptSquare five_corners;
    five_corners.indices["count"] = 5;
    EXPECT_TRUE(mentions(refusal(five_corners.write_both()), "no multiple of 3"));
}

}  // namespace
}  // namespace surimi
