// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/monitor_shapes.h"

#include "runtime/scene/gltf_surfaces.h"

#include <algorithm>

namespace surimi {

constexpr double coincidence =
    0.01;  // of the size; modelled by hand, a pair is closer than this, and separate things are not

std::vector<Triangle> triangles_of(const Scene& scene, const std::vector<size_t>& surfaces) {
    std::vector<Triangle> triangles;
    for (const size_t s : surfaces) {
        const Surface& surface = scene.surfaces[s];
        for (const std::array<uint32_t, 3>& t : surface.triangles)
            triangles.push_back({surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]});
    }
    return triangles;
}

Polygon make_rectangle(const Vec3& center, const Vec3& u, const Vec3& v, const Vec3& front) {
    Polygon polygon{{center - u - v, center + u - v, center + u + v, center - u + v}};
    if (glm::dot(front_normal(polygon), front) < 0) std::reverse(polygon.corners.begin(), polygon.corners.end());
    return polygon;
}

Polygon sized_rectangle(const Node& node) {
    const Mat3 linear(node.to_world);
    return make_rectangle(Vec3(node.to_world[3]), linear[0] * (node.monitor_size.x / 2),
                          linear[1] * (node.monitor_size.y / 2), normal_matrix(linear) * Vec3(0, 0, 1));
}

Polygon light_rectangle(const Node& node) {
    const Mat3 linear(node.to_world);
    const double scale = std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
    const Vec3 x = normalize_or(linear[0], Vec3(1, 0, 0));
    const Vec3 z = normalize_or(linear[2] - glm::dot(linear[2], x) * x, Vec3(0, 0, 1));
    return make_rectangle(Vec3(node.to_world[3]), x * (scale * node.area_light_size.x / 2),
                          glm::cross(z, x) * (scale * node.area_light_size.y / 2), -z);
}

bool do_coincide(const Polygon& a, const Polygon& b) {
    if (a.corners.size() != b.corners.size()) return false;
    const double size = glm::length(a.corners[2] - a.corners[0]);
    return std::all_of(a.corners.begin(), a.corners.end(), [&](const Vec3& corner) {
        return std::any_of(b.corners.begin(), b.corners.end(),
                           [&](const Vec3& other) { return glm::length(corner - other) <= coincidence * size; });
    });
}

}  // namespace surimi
