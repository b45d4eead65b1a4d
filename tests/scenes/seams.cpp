// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/seams.h"

#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

constexpr double cut_at = 0.13;
constexpr double density = 16;  // texels a metre

/// Puts a quad of a surface on the map: its corners lie at `corner`, then along `u` and `v`, in texels.
void put_on_map(Surface& surface, size_t quad, const Vec2& corner, const Vec2& u, const Vec2& v) {
    surface.uv_sets.resize(2);
    for (auto& set : surface.uv_sets) set.resize(surface.positions.size(), Vec2(0));
    const std::array<Vec2, 4> places = {corner, corner + u, corner + u + v, corner + v};
    for (size_t i = 0; i < 4; ++i) surface.uv_sets[1][4 * quad + i] = places[i] / static_cast<double>(cut_plane_map);
}

uint32_t add_floor(Scene& scene, const char* name, double from, double to) {
    return add_quad(scene, name, {from, 0, 1}, {to, 0, 1}, {to, 0, -1}, {from, 0, -1});
}

/// A monitor above and a sheet between it and the floor.
void add_light(Scene& scene) {
    add_quad(scene, "Sheet", {-0.9, 1, 1.2}, {0.2, 1, 1.4}, {0.2, 1, -1.3}, {-0.6, 1, -1.2});
    put_on_map(scene.surfaces.back(), 0, {100, 40}, {10, 0}, {0, 24});
    add_monitor(scene, "Monitor_R", 0, {0.1, 2.5, 0.05}, {0.6, 0, 0}, {0, 0, 0.4});
    put_on_map(scene.surfaces.back(), 0, {100, 100}, {12, 0}, {0, 8});
}

/// The second surface's triangles become those of the first.
void join(Scene& scene) {
    const Surface& other = scene.surfaces[1];
    Surface& whole = scene.surfaces[0];
    const auto first = static_cast<uint32_t>(whole.positions.size());
    whole.positions.insert(whole.positions.end(), other.positions.begin(), other.positions.end());
    whole.normals.insert(whole.normals.end(), other.normals.begin(), other.normals.end());
    for (size_t set = 0; set < 2; ++set)
        whole.uv_sets[set].insert(whole.uv_sets[set].end(), other.uv_sets[set].begin(), other.uv_sets[set].end());
    for (const auto& [a, b, c] : other.triangles) whole.triangles.push_back({first + a, first + b, first + c});
    for (uint32_t i = 0; i < 2; ++i) whole.source_triangle.push_back(2 + i);
    for (uint32_t i = 0; i < 4; ++i) whole.source_vertex.push_back(first + i);
    scene.surfaces.erase(scene.surfaces.begin() + 1);
}

}  // namespace

CutPlane cut_plane(Cut cut) {
    CutPlane stage;
    stage.joint = {{cut_at, 0, 1}, {cut_at, 0, -1}, {1, 0, 0}};
    Scene& scene = stage.scene;
    if (cut == Cut::nowhere) {
        stage.surfaces = {add_floor(scene, "Floor", -2, 2)};
        put_on_map(scene.surfaces[0], 0, {3.3, 4.7}, {4 * density, 0}, {0, 2 * density});
        add_light(scene);
        return stage;
    }
    stage.surfaces = {add_floor(scene, "Left", -2, cut_at), add_floor(scene, "Right", cut_at, 2)};
    put_on_map(scene.surfaces[0], 0, {3.3, 4.7}, {(2 + cut_at) * density, 0}, {0, 2 * density});
    put_on_map(scene.surfaces[1], 0, {50.6, 78.2}, {0, -(2 - cut_at) * density}, {2 * density, 0});
    if (cut == Cut::charts) {
        join(scene);
        stage.surfaces = {0};
    }
    add_light(scene);
    if (cut == Cut::pages)
        for (Surface& surface : scene.surfaces) surface.uv_sets.clear();
    return stage;
}

ArtefactScene box_with_hard_edges() {
    ArtefactScene stage;
    stage.surfaces = {add_box(stage.scene, "Box", {0, 0.2, 0}, {1, 0.4, 0.8})};
    add_quad(stage.scene, "Sheet", {-0.9, 1, 1.2}, {0.2, 1, 1.4}, {0.2, 1, -1.3}, {-0.6, 1, -1.2});
    add_monitor(stage.scene, "Monitor_R", 0, {1.1, 2.5, 1.05}, {0.6, 0, 0}, {0, 0, 0.4});
    return stage;
}

}  // namespace surimi::test
