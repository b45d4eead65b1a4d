// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/shade.h"

#include <algorithm>

#include "runtime/base/random.h"
#include "runtime/image/image_file.h"
#include "runtime/ltc/polygon.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

Vec3 linear_color(const Vec4& srgb) {
    return {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
}

/// Lightmap coordinates of a point: the set that carries the map, else TEXCOORD_1, else none (NaN reads as texel 0).
Vec2 lightmap_uv(const Surface& surface, const Material& material, const SurfacePoint& at) {
    const auto set = static_cast<size_t>(material.visibility_map.image >= 0 ? material.visibility_map.uv_set : 1);
    if (set >= surface.uv_sets.size()) return Vec2(NAN);
    const auto& uvs = surface.uv_sets[set];
    const auto& [i, j, k] = surface.triangles[at.triangle.triangle];
    return at.barycentric.x * uvs[i] + at.barycentric.y * uvs[j] + at.barycentric.z * uvs[k];
}

Vec3 texel_color(const VisibilityMap& map, const Vec2& uv) {
    const auto x = static_cast<int64_t>(uv.x * map.visibility.width),
               y = static_cast<int64_t>(uv.y * map.visibility.height);
    const uint64_t h = hash(static_cast<uint64_t>(x / 8), static_cast<uint64_t>(y / 8));
    const Vec3 patch(unit_double(h), unit_double(hash(h)), unit_double(hash(hash(h))));
    return ((x + y) % 2 ? 0.4 : 0.8) * (0.4 + 0.6 * patch);
}

/// What the monitors send to a point, by channel: E, and V from the map.
struct Light {
    Vec3 unshadowed{0};
    Vec3 visibility{1};
};

Light light_at(const Scene& scene, const VisibilityMap& map, const SurfacePoint& at, const Vec2& uv) {
    Light light;
    const Surface& surface = scene.surfaces[at.triangle.surface];
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Monitor& monitor = scene.monitors[m];
        if (surface.monitor == static_cast<int>(m)) continue;  // a monitor does not light itself
        for (const Polygon& panel : monitor.panels)
            light.unshadowed[monitor.channel] +=
                irradiance_of_polygon<double>(panel.corners, at.position, at.normal, monitor.two_sided);
    }
    if (!map.visibility.empty() && std::isfinite(uv.x + uv.y)) light.visibility = look_up(map, uv);
    return light;
}

Vec3 lit_color(const Scene& scene, const Material& material, const SurfacePoint& at, const Light& light) {
    const Vec3 albedo =
        Vec3(material.base_color) * linear_color(look_up_texture(scene, material.base_color_texture, at));
    Vec3 irradiance(0);
    for (const Monitor& monitor : scene.monitors)
        irradiance += monitor.radiance * (light.unshadowed[monitor.channel] * light.visibility[monitor.channel]);
    return albedo * irradiance / pi;
}

Vec3 color_at(const Scene& scene, const VisibilityMap& map, const SurfacePoint& at, Show show) {
    const Surface& surface = scene.surfaces[at.triangle.surface];
    const Material& material = material_of(scene, surface);
    const Vec2 uv = lightmap_uv(surface, material, at);
    const bool has_uv = std::isfinite(uv.x + uv.y);
    switch (show) {
        case Show::uv:
            return has_uv ? Vec3(uv, 0) : Vec3(0);
        case Show::texels:
            return has_uv && !map.visibility.empty() ? texel_color(map, uv) : Vec3(0);
        case Show::normals:
            return 0.5 * (at.normal + 1.0);
        default:
            break;
    }
    const Light light = light_at(scene, map, at, uv);
    switch (show) {
        case Show::visibility:
            return light.visibility;
        case Show::unshadowed:
            return light.unshadowed / pi;
        case Show::shadowed:
            return light.unshadowed * light.visibility / pi;
        default:
            return lit_color(scene, material, at, light);
    }
}

Vec3 emission(const Scene& scene, const Material& material, const SurfacePoint& at) {
    if (material.emissive == Vec3(0)) return Vec3(0);
    return material.emissive * linear_color(look_up_texture(scene, material.emissive_texture, at));
}

}  // namespace

Seen see(const Scene& scene, const VisibilityMap& map, const RayScene& rays, const Vec3& eye, const Vec3& direction,
         Show show) {
    Seen seen;
    Vec3 origin = eye;
    double through = 1, travelled = 0;  // share of the ray that goes on; lengths of `direction`
    constexpr int most_layers = 32;     // behind so many panes and unseen back faces nothing is missed
    for (int layer = 0; layer < most_layers && through > 1e-3; ++layer) {
        const auto hit = rays.closest_hit(origin, direction);
        if (!hit) break;
        travelled += hit->distance;
        if (hit->triangle.surface >= scene.surfaces.size()) {  // a panel that the configuration describes
            const Monitor& monitor = scene.monitors[hit->triangle.surface - scene.surfaces.size()];
            if (hit->is_front || monitor.two_sided)
                seen.color += through * (show == Show::lit ? monitor.radiance : Vec3(1));
            seen.distance = std::min(seen.distance, travelled * glm::length(direction));
            break;
        }
        SurfacePoint at = surface_point(scene, hit->triangle, hit->barycentric);
        const Material& material = material_of(scene, scene.surfaces[at.triangle.surface]);
        const Vec3 front = at.geometric_normal;
        if (hit->is_front || material.double_sided) {
            if (!hit->is_front) at.normal = -at.normal, at.geometric_normal = -at.geometric_normal;
            const bool is_blended = material.alpha_mode == AlphaMode::blend && show == Show::lit;
            const double opacity = is_blended ? std::clamp(alpha_at(scene, material, at), 0.0, 1.0) : 1;
            const Vec3 glow = show == Show::lit ? emission(scene, material, at) : Vec3(0);
            seen.color += through * (opacity * color_at(scene, map, at, show) + glow);
            if (opacity > 0.5 && through > 0.5) seen.is_surface = glow == Vec3(0);
            seen.distance = std::min(seen.distance, travelled * glm::length(direction));
            through *= 1 - opacity;
        }
        SurfacePoint beyond = at;  // go on from the far side
        beyond.geometric_normal = hit->is_front ? -front : front;
        origin = rays.ray_origin(beyond);
    }
    return seen;
}

}  // namespace surimi
