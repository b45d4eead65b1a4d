// SPDX-License-Identifier: Apache-2.0
// Writes a room of the study of visibility as .glb, for the command line:
// `cmake --build --preset release --target make_scene && build/release/bin/make_scene million million.glb`
#include <cstdio>
#include <stdexcept>

#include "tests/support/occlusion_scenes.h"
#include "tests/unit/glb_builder.h"

namespace surimi {
namespace {

std::vector<float> as_floats(const std::vector<Vec3>& values) {
    std::vector<float> floats;
    for (const Vec3& v : values)
        for (int c = 0; c < 3; ++c) floats.push_back(static_cast<float>(v[c]));
    return floats;
}

void write(const Scene& scene, const char* path) {
    test::GlbBuilder builder;
    test::Json nodes = test::Json::array(), meshes = test::Json::array(), numbers = test::Json::array();
    for (const Surface& surface : scene.surfaces) {
        std::vector<uint32_t> indices;
        for (const auto& triangle : surface.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
        const std::vector<float> positions = as_floats(surface.positions);
        const int position = builder.add_floats(positions, "VEC3");
        std::array<float, 3> low{}, high{};
        for (size_t c = 0; c < 3; ++c) low[c] = high[c] = positions[c];
        for (size_t i = 0; i < positions.size(); ++i) {
            low[i % 3] = std::min(low[i % 3], positions[i]);
            high[i % 3] = std::max(high[i % 3], positions[i]);
        }
        builder.json["accessors"].back()["min"] = low;
        builder.json["accessors"].back()["max"] = high;
        const int normal = builder.add_floats(as_floats(surface.normals), "VEC3");
        const int corners = builder.add(indices, 5125, "SCALAR");
        const test::Json primitive{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", corners}};
        meshes.push_back({{"primitives", test::Json::array({primitive})}});
        nodes.push_back({{"name", surface.name}, {"mesh", meshes.size() - 1}});
        numbers.push_back(nodes.size() - 1);
    }
    builder.json["nodes"] = nodes;
    builder.json["meshes"] = meshes;
    builder.json["scenes"] = test::Json::array({{{"nodes", numbers}}});
    builder.json["scene"] = 0;
    builder.write(path);
}

}  // namespace
}  // namespace surimi

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: make_scene low|mid|high|leaf|million FILE.glb\n", stderr);
        return 2;
    }
    try {
        const surimi::Scene scene = surimi::test::room_with(surimi::test::contents_named(argv[1]));
        surimi::write(scene, argv[2]);
        std::printf("%s: %zu triangles\n", argv[2], surimi::triangle_count(scene));
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
