// SPDX-License-Identifier: Apache-2.0
#include "runtime/visibility/baked.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/error.h"
#include "runtime/map/map_file.h"
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

size_t page_count(const Scene& scene) {
    size_t count = 1;
    for (const Material& m : scene.materials) count = std::max(count, static_cast<size_t>(m.visibility_page) + 1);
    return count;
}

std::vector<VisibilityMap> carried_pages(const Scene& scene) {
    std::vector<VisibilityMap> pages;
    for (const Material& material : scene.materials) {
        if (material.visibility_map.image < 0) continue;
        pages.resize(page_count(scene));
        VisibilityMap& page = pages[static_cast<size_t>(material.visibility_page)];
        if (!page.visibility.empty()) continue;
        const auto& image = scene.images[static_cast<size_t>(material.visibility_map.image)];
        if (image.empty())
            throw Error(ErrorKind::scene,
                        scene.path.string() + ": its visibility map could not be decoded; give one with --map");
        page = map_from_image(image, material.visibility_is_srgb);
    }
    return pages;
}

const VisibilityMap* map_at(const Scene& scene, const std::vector<VisibilityMap>& pages, const SurfacePoint& at) {
    const Surface& surface = scene.surfaces[at.triangle.surface];
    if (!surface.receives) return nullptr;
    const auto page = static_cast<size_t>(material_of(scene, surface).visibility_page);
    return page < pages.size() && !pages[page].visibility.empty() ? &pages[page] : nullptr;
}

Vec3 baked_visibility(const Scene& scene, const std::vector<VisibilityMap>& pages, const SurfacePoint& at) {
    const VisibilityMap* map = map_at(scene, pages, at);
    if (map == nullptr) return Vec3(1);
    const Vec2 uv = lightmap_uv(scene, at);
    return std::isfinite(uv.x + uv.y) ? look_up(*map, uv) : Vec3(1);
}

}  // namespace surimi
