// SPDX-License-Identifier: Apache-2.0
// A place on a surface: what rays start from and what shading speaks about.
#pragma once

#include "runtime/scene/scene.h"

namespace surimi {

struct TriangleRef {
    uint32_t surface = 0;   ///< index into Scene::surfaces
    uint32_t triangle = 0;  ///< index into Surface::triangles
};

struct SurfacePoint {
    TriangleRef triangle;
    Vec3 barycentric{1, 0, 0};  ///< weights of the triangle's corners
    Vec3 position{0};
    Vec3 normal{0, 0, 1};            ///< unit, interpolated from the vertices
    Vec3 geometric_normal{0, 0, 1};  ///< unit, of the triangle's front side
};

/// The point with these barycentric weights (non-negative, sum 1). Where the vertices' normals cancel, `normal` is the
/// geometric one.
inline SurfacePoint surface_point(const Scene& scene, const TriangleRef& where, const Vec3& barycentric) {
    const Surface& surface = scene.surfaces[where.surface];
    const auto& [i, j, k] = surface.triangles[where.triangle];
    const Vec3 &a = surface.positions[i], &b = surface.positions[j], &c = surface.positions[k];
    const auto& n = surface.normals;
    SurfacePoint point;
    point.triangle = where;
    point.barycentric = barycentric;
    point.position = barycentric.x * a + barycentric.y * b + barycentric.z * c;
    point.geometric_normal = normalize_or(area_normal(a, b, c), n[i]);
    point.normal =
        normalize_or(barycentric.x * n[i] + barycentric.y * n[j] + barycentric.z * n[k], point.geometric_normal);
    return point;
}

}  // namespace surimi
