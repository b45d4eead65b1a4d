// SPDX-License-Identifier: Apache-2.0
// Visibility from the map, or from the maps that are the pages of a bake.
#pragma once

#include <vector>

#include "runtime/map/visibility_map.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

/// Lightmap coordinates of a point: of the set that carries the map, else TEXCOORD_1; NaN where the surface has none.
Vec2 lightmap_uv(const Scene& scene, const SurfacePoint& at);

/// How many maps the scene was baked into, by the pages that its materials name; 1 for an unbaked one.
size_t page_count(const Scene& scene);

/// The maps that a baked scene carries, by page; empty where no material carries one. A page without a carrier is an
/// empty map. Throws Error(scene) when one could not be decoded.
std::vector<VisibilityMap> carried_pages(const Scene& scene);

/// The map of the page that a point lies on; null where there is none, and on surfaces that do not receive.
const VisibilityMap* map_at(const Scene& scene, const std::vector<VisibilityMap>& pages, const SurfacePoint& at);

/// V of the three channels at a point; 1 without a map or without lightmap coordinates.
Vec3 baked_visibility(const Scene& scene, const std::vector<VisibilityMap>& pages, const SurfacePoint& at);

}  // namespace surimi
