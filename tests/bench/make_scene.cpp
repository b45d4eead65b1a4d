// SPDX-License-Identifier: Apache-2.0
// Writes a room of the study of visibility, or the scene of an artefact, as .glb, for the command line and the oracle:
// `cmake --build --preset release --target make_scene && build/release/bin/make_scene million million.glb`
#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tests/scenes/catalogue.h"
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

/// What decides which sides there are and what lets light through.
test::Json json_of(const Material& material) {
    test::Json json{{"name", material.name}, {"doubleSided", material.double_sided}};
    if (material.transmission > 0)
        json["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", material.transmission}}}};
    return json;
}

void add_materials(const Scene& scene, test::GlbBuilder& builder) {
    for (const Material& material : scene.materials) {
        builder.json["materials"].push_back(json_of(material));
        if (material.transmission > 0) builder.json["extensionsUsed"] = {"KHR_materials_transmission"};
    }
}

/// TEXCOORD_0 and TEXCOORD_1, where the surface has them.
void add_uv_sets(const Surface& surface, test::GlbBuilder& builder, test::Json& attributes) {
    for (size_t set = 0; set < surface.uv_sets.size(); ++set) {
        std::vector<float> floats;
        for (const Vec2& uv : surface.uv_sets[set])
            floats.insert(floats.end(), {static_cast<float>(uv.x), static_cast<float>(uv.y)});
        attributes["TEXCOORD_" + std::to_string(set)] = builder.add_floats(floats, "VEC2");
    }
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
        test::Json attributes{{"POSITION", position}, {"NORMAL", normal}};
        add_uv_sets(surface, builder, attributes);
        test::Json primitive{{"attributes", attributes}, {"indices", corners}};
        if (surface.material >= 0) primitive["material"] = surface.material;
        meshes.push_back({{"primitives", test::Json::array({primitive})}});
        nodes.push_back({{"name", surface.name}, {"mesh", meshes.size() - 1}});
        numbers.push_back(nodes.size() - 1);
    }
    add_materials(scene, builder);
    builder.json["nodes"] = nodes;
    builder.json["meshes"] = meshes;
    builder.json["scenes"] = test::Json::array({{{"nodes", numbers}}});
    builder.json["scene"] = 0;
    builder.write(path);
}

bool is_artefact(const std::string& name) {
    const auto& all = test::all_artefacts();
    return std::any_of(all.begin(), all.end(), [&](const auto& artefact) { return artefact.name == name; });
}

Scene scene_named(const std::string& name) {
    if (is_artefact(name)) return test::artefact_named(name).scene;
    return test::room_with(test::contents_named(name));
}

}  // namespace
}  // namespace surimi

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: make_scene low|mid|high|leaf|million|ARTEFACT FILE.glb; artefacts:", stderr);
        for (const auto& artefact : surimi::test::all_artefacts()) std::fprintf(stderr, " %s", artefact.name.c_str());
        std::fputs("\n", stderr);
        return 2;
    }
    try {
        const surimi::Scene scene = surimi::scene_named(argv[1]);
        surimi::write(scene, argv[2]);
        std::printf("%s: %zu triangles\n", argv[2], surimi::triangle_count(scene));
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
