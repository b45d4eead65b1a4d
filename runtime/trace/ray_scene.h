// SPDX-License-Identifier: Apache-2.0
// Rays against a scene. The only room that sees Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "runtime/scene/surface_point.h"

namespace surimi {

struct Hit {
    TriangleRef triangle;  ///< surface == Scene::surfaces.size() + m: a panel of monitor m, which has no surface
    Vec3 barycentric{1, 0, 0};
    double distance = 0;   ///< in lengths of the ray's direction
    bool is_front = true;  ///< the side that the triangle's winding shows
};

/// Owns the acceleration structure of one scene; the scene must outlive it. Calls are thread-safe.
class RayScene {
  public:
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Where rays from the front of `point` start: far enough off its triangle that none of them meets it again, and no
    /// farther (M5). The distance covers the rounding of vertices and origin to float, relative to the scene's centre.
    Vec3 ray_origin(const SurfacePoint& point) const;

    /// Is anything between `origin` (see ray_origin) and `target`, a point on monitor `monitor`? Surfaces of that
    /// monitor do not count, nor does what lies within 1e-4 of the distance before the target. Alpha-masked holes let
    /// light through; blended and transmissive materials block it.
    bool is_occluded(const Vec3& origin, const Vec3& target, size_t monitor) const;

    /// Nearest surface along a ray; alpha-masked holes are not hit.
    std::optional<Hit> closest_hit(const Vec3& origin, const Vec3& direction) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace surimi
