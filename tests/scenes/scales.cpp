// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/scales.h"

#include "tests/support/scenes.h"
#include "tests/unit/glb_builder.h"

namespace surimi::test {
namespace {

/// Lays every quad of the scene's surfaces out on the map as a chart of its own, at one density, in rows.
void lay_out(Scene& scene, double texels_per_metre) {
    constexpr double gap = 4;
    double x = gap, y = gap, row = 0;
    for (Surface& surface : scene.surfaces) {
        surface.uv_sets.assign(2, std::vector<Vec2>(surface.positions.size(), Vec2(0)));
        for (size_t first = 0; first + 3 < surface.positions.size(); first += 4) {
            const Vec3* p = &surface.positions[first];
            const double width = std::ceil(texels_per_metre * glm::length(p[1] - p[0]));
            const double height = std::ceil(texels_per_metre * glm::length(p[3] - p[0]));
            if (x + width + gap > room_map) x = gap, y += row + gap, row = 0;
            if (y + height + gap > room_map) throw std::logic_error("the room's charts do not fit");
            const std::array<Vec2, 4> places = {Vec2(x, y), Vec2(x + width, y), Vec2(x + width, y + height),
                                                Vec2(x, y + height)};
            for (size_t i = 0; i < 4; ++i) surface.uv_sets[1][first + i] = places[i] / static_cast<double>(room_map);
            x += width + gap;
            row = std::max(row, height);
        }
    }
}

/// A file with a floor, a monitor above it and one block, as meshes 0, 1 and 2.
struct BlocksFile : GlbBuilder {
    BlocksFile() {
        Scene scene;
        add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        add_monitor(scene, "Monitor_R", 0, {0, 2.5, -0.05}, {0.6, 0, 0}, {0, 0, 0.4});
        add_box(scene, "Block", {0.9, 0.5, 0.2}, {0.5, 0.9, 0.7});
        json["meshes"] = Json::array();
        for (const Surface& surface : scene.surfaces) {
            std::vector<float> positions, normals;
            std::vector<uint16_t> corners;
            for (size_t i = 0; i < surface.positions.size(); ++i)
                for (int c = 0; c < 3; ++c) {
                    positions.push_back(static_cast<float>(surface.positions[i][c]));
                    normals.push_back(static_cast<float>(surface.normals[i][c]));
                }
            for (const auto& triangle : surface.triangles)
                for (const uint32_t corner : triangle) corners.push_back(static_cast<uint16_t>(corner));
            const int position = add_floats(positions, "VEC3"), normal = add_floats(normals, "VEC3");
            const Json attributes{{"POSITION", position}, {"NORMAL", normal}};
            const Json primitive{{"attributes", attributes}, {"indices", add_indices(corners)}};
            json["meshes"].push_back({{"primitives", Json::array({primitive})}});
        }
        json["nodes"] = {{{"name", "Floor"}, {"mesh", 0}},
                         {{"name", "Monitor_R"}, {"mesh", 1}},
                         {{"name", "Block"}, {"mesh", 2}},
                         {{"name", "Mirrored"}, {"mesh", 2}, {"scale", {-1, 1, 1}}}};
        json["scene"] = 0;
    }
    void write_all(const std::filesystem::path& file) {
        Json numbers = Json::array();
        for (size_t i = 0; i < json["nodes"].size(); ++i) numbers.push_back(i);
        json["scenes"] = Json::array({{{"nodes", numbers}}});
        write(file);
    }
};

}  // namespace

ArtefactScene furnished_room() {
    ArtefactScene stage;
    Scene& scene = stage.scene;
    add_box(scene, "Room", {0, 1.25, 0}, {4, 2.5, 4}, true);
    add_box(scene, "Table", {0.3, 0.7, -0.4}, {1.2, 0.05, 0.7});
    add_box(scene, "Leg", {0.8, 0.3, -0.6}, {0.06, 0.6, 0.06});
    add_box(scene, "Cupboard", {1.2, 0.55, 1.1}, {0.5, 1, 0.9});
    add_box(scene, "Lamp", {-0.7, 1.6, 0.5}, {0.3, 0.2, 0.3});
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) stage.surfaces.push_back(s);
    add_monitor(scene, "Monitor_R", 0, {-1.97, 1.1, 0.1}, {0, 0, -0.8}, {0, 0.45, 0});
    lay_out(scene, 14);
    return stage;
}

void write_mirrored_blocks(const std::filesystem::path& file) {
    BlocksFile().write_all(file);
}

void write_blocks_and_nothing(const std::filesystem::path& file) {
    BlocksFile blocks;
    blocks.json["nodes"].push_back({{"name", "Nothing"}, {"mesh", 2}, {"scale", {0, 0, 0}}});
    blocks.write_all(file);
}

void write_blocks_and_a_flat_one(const std::filesystem::path& file) {
    BlocksFile blocks;
    blocks.json["nodes"].push_back({{"name", "Flat"}, {"mesh", 2}, {"scale", {1, 0, 1}}});
    blocks.write_all(file);
}

}  // namespace surimi::test
