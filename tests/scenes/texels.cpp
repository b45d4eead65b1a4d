// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/texels.h"

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

/// Puts vertices on the map by texels, in their order.
void put_on_map(Surface& surface, const std::vector<Vec2>& places) {
    surface.uv_sets.assign(2, std::vector<Vec2>(surface.positions.size(), Vec2(0)));
    for (size_t i = 0; i < places.size(); ++i) surface.uv_sets[1][i] = places[i] / static_cast<double>(odd_texel_map);
}

void put_quad_on_map(Surface& surface, const Vec2& low, const Vec2& high) {
    put_on_map(surface, {low, {high.x, low.y}, high, {low.x, high.y}});
}

/// Two quads of 1 m that share the edge x = 0, the second folded down by `fold`. Texels have 1/8 m; the edge is in the
/// middle of a column of them.
uint32_t add_roof(Scene& scene, double fold) {
    const Vec3 down(std::cos(fold), -std::sin(fold), 0), up_a(0, 1, 0), up_b(std::sin(fold), std::cos(fold), 0);
    Surface surface;
    const uint32_t index = add_quad(scene, "Roof", {-1, 0, 0.5}, {0, 0, 0.5}, {0, 0, -0.5}, {-1, 0, -0.5});
    Surface& roof = scene.surfaces[index];
    for (const Vec3& p : {Vec3(0, 0, 0.5), down + Vec3(0, 0, 0.5), down - Vec3(0, 0, 0.5), Vec3(0, 0, -0.5)}) {
        roof.positions.push_back(p);
        roof.normals.push_back(up_b);
    }
    roof.triangles.push_back({4, 5, 6});
    roof.triangles.push_back({4, 6, 7});
    roof.source_triangle = {0, 1, 2, 3};
    roof.source_vertex = {0, 1, 2, 3, 4, 5, 6, 7};
    put_on_map(roof, {{2.5, 4}, {10.5, 4}, {10.5, 12}, {2.5, 12}, {10.5, 4}, {18.5, 4}, {18.5, 12}, {10.5, 12}});
    return index;
}

}  // namespace

ArtefactScene sliver_charts() {
    ArtefactScene stage;
    Mesh plate;  // needles of 1 m x 1 mm whose borders are no common edges: each is a chart of its own
    for (uint32_t i = 0; i < 24; ++i) {
        const double x = 0.02 * i;
        plate.positions.insert(plate.positions.end(), {{x, 0, 0.5}, {x + 0.001, 0, 0.5}, {x + 0.0005, 0, -0.5}});
        plate.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    stage.surfaces = {add_surface(stage.scene, "Needles", plate)};
    Mesh fan;
    fan.positions.push_back({-1, 0, 0});
    for (uint32_t i = 0; i <= 64; ++i) {
        const double angle = 0.002 * i;
        fan.positions.push_back(Vec3(-1, 0, 0) + Vec3(std::cos(angle), 0, -std::sin(angle)));
        if (i > 0) fan.triangles.push_back({0, i, i + 1});
    }
    stage.surfaces.push_back(add_surface(stage.scene, "Fan", fan));
    add_monitor(stage.scene, "Monitor_R", 0, {0.1, 2.5, -0.05}, {0.6, 0, 0}, {0, 0, 0.4});
    return stage;
}

ArtefactScene texels_with_two_shadows() {
    ArtefactScene stage;
    stage.surfaces = {add_roof(stage.scene, 0)};
    add_quad(stage.scene, "Wall", {0, 0, 2}, {0, 3, 2}, {0, 3, -2}, {0, 0, -2});
    put_quad_on_map(stage.scene.surfaces.back(), {2, 18}, {14, 26});
    stage.scene.materials.push_back({});
    stage.scene.materials[0].double_sided = true;  // or what is dark behind the wall would be where nobody looks
    for (Surface& surface : stage.scene.surfaces) surface.material = 0;
    add_monitor(stage.scene, "Monitor_R", 0, {-2, 1, 0}, {0, 0, -0.6}, {0, 0.4, 0});
    put_quad_on_map(stage.scene.surfaces.back(), {22, 18}, {30, 26});
    return stage;
}

ArtefactScene texels_with_two_normals() {
    ArtefactScene stage;
    stage.surfaces = {add_roof(stage.scene, pi / 3)};
    add_monitor(stage.scene, "Monitor_R", 0, {0.3, 2, 0}, {0.6, 0, 0}, {0, 0, 0.4});
    put_quad_on_map(stage.scene.surfaces.back(), {22, 18}, {30, 26});
    return stage;
}

ArtefactScene texel_at_the_origin() {
    ArtefactScene stage;
    stage.surfaces = {add_quad(stage.scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2})};
    put_quad_on_map(stage.scene.surfaces[0], {2, 2}, {19, 19});  // 17 texels: the tenth has its centre in the middle
    add_quad(stage.scene, "Sheet", {-2, 1, 1}, {0.03, 1, 1}, {0.03, 1, -1}, {-2, 1, -1});
    put_quad_on_map(stage.scene.surfaces.back(), {22, 2}, {30, 14});
    add_monitor(stage.scene, "Monitor_R", 0, {0.1, 2.5, -0.05}, {0.6, 0, 0}, {0, 0, 0.4});
    put_quad_on_map(stage.scene.surfaces.back(), {22, 18}, {30, 26});
    return stage;
}

ArtefactScene black_beside_unlit() {
    ArtefactScene stage;
    stage.surfaces = {add_quad(stage.scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2})};
    add_quad(stage.scene, "Blind", {0.2, -0.5, 3}, {0.2, 3, 3}, {0.2, 3, -3}, {0.2, -0.5, -3});
    add_quad(stage.scene, "Shelf", {-0.2, 0.5, 3}, {0.3, 0.5, 3}, {0.3, 0.5, -3}, {-0.2, 0.5, -3});
    add_monitor(stage.scene, "Monitor_R", 0, {0.1, 1, 0}, {0, 0, -0.6}, {0, 0.4, 0});
    return stage;
}

}  // namespace surimi::test
