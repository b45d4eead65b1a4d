// SPDX-License-Identifier: Apache-2.0
// What a camera ray sees.
#pragma once

#include "runtime/map/visibility_map.h"
#include "runtime/preview/render.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

struct Seen {
    Vec3 color{0};
    bool is_surface = false;     ///< something that does not emit took most of the ray
    double distance = INFINITY;  ///< metres to the first thing seen
};

/// Follows a camera ray through blended surfaces and unseen back faces. `direction` need not be unit.
Seen see(const Scene& scene, const VisibilityMap& map, const RayScene& rays, const Vec3& eye, const Vec3& direction,
         Show show);

}  // namespace surimi
