// SPDX-License-Identifier: Apache-2.0
// Views of what lighting is made of.
#include "runtime/preview/see.h"

#include "runtime/base/random.h"
#include "runtime/ltc/polygon.h"
#include "runtime/visibility/baked.h"

namespace surimi {
namespace {

/// A checker of texels, every eight by eight in a colour of its own.
Vec3 texel_color(const VisibilityMap& map, const Vec2& uv) {
    const auto x = static_cast<int64_t>(uv.x * map.visibility.width),
               y = static_cast<int64_t>(uv.y * map.visibility.height);
    const uint64_t h = hash(static_cast<uint64_t>(x / 8), static_cast<uint64_t>(y / 8));
    const Vec3 patch(unit_double(h), unit_double(hash(h)), unit_double(hash(hash(h))));
    return ((x + y) % 2 ? 0.4 : 0.8) * (0.4 + 0.6 * patch);
}

/// E / pi of the three channels, of the unmapped normal: what the map was baked with.
Vec3 unshadowed(const Scene& scene, const SurfacePoint& at) {
    Vec3 irradiance(0);
    const Surface& surface = scene.surfaces[at.triangle.surface];
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Monitor& monitor = scene.monitors[m];
        if (surface.monitor == static_cast<int>(m)) continue;  // a monitor does not light itself
        for (const Polygon& panel : monitor.panels)
            irradiance[monitor.channel] +=
                irradiance_of_polygon<double>(panel.corners, at.position, at.normal, monitor.two_sided);
    }
    return irradiance / pi;
}

}  // namespace

Vec3 view_color(const Lighting& lighting, const ShadingPoint& point, Show show) {
    const Vec2 uv = lightmap_uv(lighting.scene, point.at);
    const bool has_uv = std::isfinite(uv.x + uv.y);
    const VisibilityMap* map = map_at(lighting.scene, lighting.pages, point.at);
    switch (show) {
        case Show::visibility:
            return baked_visibility(lighting.scene, lighting.pages, point.at);
        case Show::unshadowed:
            return unshadowed(lighting.scene, point.at);
        case Show::shadowed:
            return unshadowed(lighting.scene, point.at) * baked_visibility(lighting.scene, lighting.pages, point.at);
        case Show::uv:
            return has_uv ? Vec3(uv, 0) : Vec3(0);
        case Show::texels:
            return has_uv && map != nullptr ? texel_color(*map, uv) : Vec3(0);
        case Show::normals:
            return 0.5 * (point.normal + 1.0);
        case Show::roughness:
            return Vec3(point.roughness);
        default:
            return Vec3(0);  // lit views: shaded elsewhere
    }
}

}  // namespace surimi
