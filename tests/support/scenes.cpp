// SPDX-License-Identifier: Apache-2.0
#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

Surface& new_surface(Scene& scene, const std::string& name) {
    Node node;
    node.name = name;
    node.is_in_scene = true;
    node.mesh = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(node);
    Surface& surface = scene.surfaces.emplace_back();
    surface.name = name;
    surface.node = static_cast<int>(scene.nodes.size()) - 1;
    surface.mesh = node.mesh;
    return surface;
}

void append_quad(Surface& surface, const std::array<Vec3, 4>& corners) {
    const auto first = static_cast<uint32_t>(surface.positions.size());
    const Vec3 normal = glm::normalize(area_normal(corners[0], corners[1], corners[2]));
    for (const Vec3& corner : corners) {
        surface.source_vertex.push_back(static_cast<uint32_t>(surface.positions.size()));
        surface.positions.push_back(corner);
        surface.normals.push_back(normal);
    }
    for (const auto& t : {std::array<uint32_t, 3>{first, first + 1, first + 2}, {first, first + 2, first + 3}}) {
        surface.source_triangle.push_back(static_cast<uint32_t>(surface.triangles.size()));
        surface.triangles.push_back(t);
    }
}

}  // namespace

uint32_t add_quad(Scene& scene, const std::string& name, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    append_quad(new_surface(scene, name), {a, b, c, d});
    return static_cast<uint32_t>(scene.surfaces.size()) - 1;
}

uint32_t add_box(Scene& scene, const std::string& name, const Vec3& center, const Vec3& size, bool inwards) {
    Surface& surface = new_surface(scene, name);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 n(0), u(0), v(0);
            n[axis] = side * 0.5 * size[axis];
            u[(axis + 1) % 3] = 0.5 * size[(axis + 1) % 3];
            v[(axis + 2) % 3] = 0.5 * size[(axis + 2) % 3];
            const Vec3 w = (side > 0) != inwards ? v : -v;  // u x v points along +axis
            append_quad(surface, {center + n - u - w, center + n + u - w, center + n + u + w, center + n - u + w});
        }
    }
    return static_cast<uint32_t>(scene.surfaces.size()) - 1;
}

void add_monitor(Scene& scene, const std::string& name, int channel, const Vec3& center, const Vec3& half_u,
                 const Vec3& half_v) {
    const std::array<Vec3, 4> c = {center - half_u - half_v, center + half_u - half_v, center + half_u + half_v,
                                   center - half_u + half_v};
    const uint32_t index = add_quad(scene, name, c[0], c[1], c[2], c[3]);
    scene.surfaces[index].monitor = static_cast<int>(scene.monitors.size());
    Monitor monitor;
    monitor.name = name;
    monitor.node = scene.surfaces[index].node;
    monitor.channel = channel;
    monitor.panels = {{{c.begin(), c.end()}}};
    monitor.reason = "built in code";
    scene.monitors.push_back(monitor);
}

Scene kanikama_room() {
    Scene scene;
    // The numbers are in Unity's left-handed frame; z is mirrored, which changes nothing about visibility.
    const auto at = [](double x, double y, double z) { return Vec3(x, y, -z); };
    add_box(scene, "Room", Vec3(0), Vec3(6), true);
    add_box(scene, "Wall_1", at(1, -2.25, 1), {2.5, 1.5, 0.5});
    add_box(scene, "Wall_2", at(-1, -2.25, -1), {0.5, 1.5, 2.5});
    add_box(scene, "Pillar", at(-2.25, 0, 2.25), {1.5, 6, 1.5});
    add_box(scene, "Cube", at(1.5, -2.75, -1.5), Vec3(0.5));
    const double half_width = 2.6616 / 2, half_height = 1.4972 / 2;
    add_monitor(scene, "Monitor_R", 0, at(-2.986, -1.47, -1), {0, 0, -half_width}, {0, half_height, 0});
    add_monitor(scene, "Monitor_G", 1, at(1, -1.47, 2.997), {half_width, 0, 0}, {0, half_height, 0});
    return scene;
}

Atlas whole_map_atlas(const Scene& scene, uint32_t quad, int size) {
    Atlas atlas;
    atlas.width = atlas.height = size;
    atlas.surfaces.resize(scene.surfaces.size());
    atlas.charts.resize(scene.surfaces.size());
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        atlas.charts[s].surface = s;
        atlas.surfaces[s].uv.resize(scene.surfaces[s].triangles.size());
        atlas.surfaces[s].chart.assign(scene.surfaces[s].triangles.size(), s);
    }
    const std::array<Vec2f, 4> corners = {Vec2f(0, 0), Vec2f(1, 0), Vec2f(1, 1), Vec2f(0, 1)};
    for (size_t t = 0; t < 2; ++t)
        for (size_t c = 0; c < 3; ++c)
            atlas.surfaces[quad].uv[t][c] = corners[scene.surfaces[quad].triangles[t][c] % 4];
    return atlas;
}

}  // namespace surimi::test
