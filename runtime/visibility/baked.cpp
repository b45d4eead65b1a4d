// SPDX-License-Identifier: Apache-2.0
#include "runtime/visibility/baked.h"

#include <cmath>

#include "runtime/scene/texture.h"

namespace surimi {

Vec2 lightmap_uv(const Scene& scene, const SurfacePoint& at) {
    const Surface& surface = scene.surfaces[at.triangle.surface];
    const Material& material = material_of(scene, surface);
    const auto set = static_cast<size_t>(material.visibility_map.image >= 0 ? material.visibility_map.uv_set : 1);
    if (set >= surface.uv_sets.size()) return Vec2(NAN);
    const auto& uvs = surface.uv_sets[set];
    const auto& [i, j, k] = surface.triangles[at.triangle.triangle];
    return at.barycentric.x * uvs[i] + at.barycentric.y * uvs[j] + at.barycentric.z * uvs[k];
}

Vec3 baked_visibility(const Scene& scene, const VisibilityMap& map, const SurfacePoint& at) {
    if (map.visibility.empty()) return Vec3(1);
    const Vec2 uv = lightmap_uv(scene, at);
    return std::isfinite(uv.x + uv.y) ? look_up(map, uv) : Vec3(1);
}

}  // namespace surimi
