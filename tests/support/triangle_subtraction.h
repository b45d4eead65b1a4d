// SPDX-License-Identifier: Apache-2.0
// Exact visibility of a monitor from a point, by subtracting the shadow of every triangle of the scene from its panels.
// No edges, no rays, no code of the baker: a judge of all of them.
#pragma once

#include <array>
#include <vector>

#include "runtime/trace/ray_scene.h"

namespace surimi::test {

/// A monitor and all triangles that can hide it, as Embree sees them: float, relative to RayScene::center().
struct Obstructed {
    struct Panel {
        std::vector<Vec3> corners;
        Vec3 center{0}, normal{0, 0, 1};
        double clearance = 0;  ///< metres in front of the plane, within which and behind which nothing hides
    };
    Vec3 center{0};  ///< of the RayScene
    std::vector<Panel> panels;
    bool is_two_sided = false;
    std::vector<std::array<Vec3, 3>> triangles;
};

/// Throws std::invalid_argument for a scene with alpha-masked surfaces, which are no polygons.
Obstructed obstructed(const Scene& scene, const RayScene& rays, size_t monitor);

struct SubtractedIrradiance {
    double unshadowed = 0;  ///< at unit radiance
    double shadowed = 0;
    double visibility() const { return unshadowed > 0 ? shadowed / unshadowed : 0; }
};

/// At `origin` (as RayScene::ray_origin gives it) with two horizons: the panels are lit above that of `normal`, and of
/// this arrives what is above that of `geometric_normal` and behind no triangle. A triangle a, b, c, seen from the
/// origin, hides the points q of a panel with q = x a + y b + z c, where x, y, z >= 0 and x + y + z >= 1 / end: convex
/// sets, that are subtracted from a list of convex fragments. Lambert's sum over the fragments, in long double. Errors
/// are slivers, at most some 1e-15 of the panel each.
SubtractedIrradiance subtract_triangles(const Obstructed& scene, const Vec3& origin, const Vec3& normal,
                                        const Vec3& geometric_normal);

/// For a point of a surface: visibility from where its rays start, panels weighed by their light at the point itself.
SubtractedIrradiance subtract_triangles(const Obstructed& scene, const RayScene& rays, const SurfacePoint& point);

}  // namespace surimi::test
