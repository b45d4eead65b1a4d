// SPDX-License-Identifier: Apache-2.0
#include "tests/support/mesh.h"

#include <string>

#include "runtime/scene/gltf_surfaces.h"

namespace surimi::test {
namespace {

Surface surface_of(const Mesh& mesh) {
    Surface surface;
    surface.positions = mesh.positions;
    surface.normals.resize(mesh.positions.size(), Vec3(0));
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) surface.source_vertex.push_back(v);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
        if (is_degenerate(p, q, r)) continue;
        surface.triangles.push_back(mesh.triangles[t]);
        surface.source_triangle.push_back(t);
        for (const uint32_t v : mesh.triangles[t]) surface.normals[v] += glm::cross(q - p, r - p);
    }
    for (Vec3& normal : surface.normals) {
        const double length = glm::length(normal);
        normal = length > 0 ? normal / length : Vec3(0, 0, 1);
    }
    return surface;
}

}  // namespace

Scene scene_of(const std::vector<Mesh>& meshes) {
    Scene scene;
    for (const Mesh& mesh : meshes) {
        const int index = static_cast<int>(scene.surfaces.size());
        Surface surface = surface_of(mesh);
        surface.name = "mesh_" + std::to_string(index);
        surface.node = surface.mesh = index;
        Node node;
        node.name = surface.name;
        node.mesh = index;
        node.is_in_scene = true;
        scene.nodes.push_back(node);
        scene.surfaces.push_back(std::move(surface));
    }
    return scene;
}

}  // namespace surimi::test
