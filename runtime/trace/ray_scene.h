// SPDX-License-Identifier: Apache-2.0
// Rays against a scene. The only room that sees Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "runtime/scene/scene.h"

namespace surimi {

struct Hit {
    uint32_t surface = 0;
    uint32_t triangle = 0;
    Vec2 barycentric{0};  ///< weights of corners 1 and 2
    double distance = 0;  ///< metres
};

/// A point pushed off its surface far enough that no ray from it meets that surface again, and no farther: the
/// distance covers the rounding of both to float, which grows with the position's magnitude. (M8)
Vec3 offset_origin(const Vec3& position, const Vec3& geometric_normal, double magnitude);

/// Owns the acceleration structure of one scene; the scene must outlive it.
class RayScene {
  public:
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Is anything between a surface point and a point on monitor `monitor`? The monitor's own surfaces do not count,
    /// nor does whatever lies within 1e-4 of the distance before the target. `from` is the surface point itself; it is
    /// offset here.
    bool is_occluded(const Vec3& from, const Vec3& geometric_normal, const Vec3& to, int monitor) const;

    /// Nearest surface along a ray, alpha-masked holes left out. `direction` need not be unit.
    std::optional<Hit> closest_hit(const Vec3& origin, const Vec3& direction) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace surimi
