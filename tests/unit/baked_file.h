// SPDX-License-Identifier: Apache-2.0
// A small file, an atlas for it, and what the two become.
#pragma once

#include "baker/write/baked_glb.h"

#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "glb_builder.h"
#include "runtime/scene/gltf.h"

namespace surimi::test {

/// A PNG of one grey pixel, and the same as base64.
inline const std::vector<uint8_t> png{
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00,
    0x0C, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9C, 0x63, 0x68, 0x68, 0x68, 0x00, 0x00, 0x03, 0x04, 0x01, 0x81, 0x4B,
    0xD3, 0xD2, 0x10, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
inline const std::string png_base64 =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaGgAAAMEAYFL09IQAAAAAElFTkSuQmCC";
inline const CarriedMap map_of_screen{{png}, {"Screen", "", ""}};

/// Every triangle alone: all vertices are split.
inline Atlas scattered_atlas(const Scene& scene) {
    Atlas atlas;
    atlas.width = atlas.height = 64;
    float n = 0;
    for (const Surface& surface : scene.surfaces) {
        SurfaceUv uv;
        for (size_t t = 0; t < surface.triangles.size(); ++t, n += 1)
            uv.uv.push_back({Vec2f(n, 1) / 4096.0f, Vec2f(n, 2) / 4096.0f, Vec2f(n + 0.5f, 1) / 4096.0f});
        uv.chart.resize(uv.uv.size());
        atlas.surfaces.push_back(uv);
    }
    return atlas;
}

/// One uv for each vertex of the file: nothing needs a split.
inline Atlas joined_atlas(const Scene& scene) {
    Atlas atlas = scattered_atlas(scene);
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        for (size_t t = 0; t < scene.surfaces[s].triangles.size(); ++t)
            for (size_t k = 0; k < 3; ++k) {
                const auto v = static_cast<float>(scene.surfaces[s].source_vertex[scene.surfaces[s].triangles[t][k]]);
                atlas.surfaces[s].uv[t][k] = Vec2f(v, static_cast<float>(s)) / 4096.0f;
            }
    return atlas;
}

inline const std::vector<float> quad_positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
inline const std::vector<uint16_t> quad_indices{0, 1, 2, 0, 2, 3};

/// A file with one quad, on which tests build.
struct QuadFile : GlbBuilder {
    int position = add_floats(quad_positions, "VEC3");
    int normal = add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    int index = add_indices(quad_indices);

    QuadFile() {
        json["accessors"][0]["min"] = {0, 0, 0};
        json["accessors"][0]["max"] = {1, 1, 0};
        json["meshes"] = {{{"primitives", {primitive()}}}};
        json["nodes"] = {{{"name", "Wall"}, {"mesh", 0}}};
        json["scenes"] = {{{"nodes", {0}}}};
        json["scene"] = 0;
    }
    Json primitive() const {
        return {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", index}};
    }
    Json& first_primitive() { return json["meshes"][0]["primitives"][0]; }
    void add_node(const Json& node) {
        json["scenes"][0]["nodes"].push_back(json["nodes"].size());
        json["nodes"].push_back(node);
    }
};

using MakeAtlas = std::function<Atlas(const Scene&)>;

/// Reads the file, gives it an atlas, writes it.
struct Baked {
    Scene scene;
    Atlas atlas;
    std::vector<uint8_t> bytes;
    GlbFile file{bytes};

    Baked(GlbBuilder& builder, const MakeAtlas& make_atlas, const std::function<void(Scene&)>& change = {})
        : Baked(builder.write(test_folder() / "room.glb"), make_atlas, change) {}

    Baked(const std::filesystem::path& path, const MakeAtlas& make_atlas,
          const std::function<void(Scene&)>& change = {})
        : scene(changed(path, change)), atlas(make_atlas(scene)), bytes(make_baked_glb(scene, atlas, map_of_screen)) {}

    static Scene changed(const std::filesystem::path& path, const std::function<void(Scene&)>& change) {
        Scene scene = read_gltf(path);
        if (change) change(scene);
        return scene;
    }

    std::filesystem::path write(const std::filesystem::path& path) const {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return path;
    }
};

/// What the corners of a triangle list hold of one attribute.
inline std::vector<std::vector<uint8_t>> at_corners(const GlbFile& file, const Json& primitive, const Json& accessor) {
    const auto elements = file.elements(accessor);
    std::vector<std::vector<uint8_t>> result;
    for (const size_t corner : file.corners(primitive)) result.push_back(elements.at(corner));
    return result;
}

}  // namespace surimi::test
