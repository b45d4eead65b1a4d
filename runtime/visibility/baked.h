// SPDX-License-Identifier: Apache-2.0
// Visibility from the map.
#pragma once

#include "runtime/map/visibility_map.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

/// Lightmap coordinates of a point: of the set that carries the map, else TEXCOORD_1; NaN where the surface has none.
Vec2 lightmap_uv(const Scene& scene, const SurfacePoint& at);

/// V of the three channels at a point; 1 without a map or without lightmap coordinates.
Vec3 baked_visibility(const Scene& scene, const VisibilityMap& map, const SurfacePoint& at);

}  // namespace surimi
