// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/see.h"

#include <algorithm>

#include "runtime/base/random.h"
#include "runtime/material/emission.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

/// What a surface emits towards the eye; a one-sided monitor nothing to its back.
Vec3 glow(const Lighting& lighting, const SurfacePoint& at, bool is_front, Show show) {
    const Scene& scene = lighting.scene;
    const int monitor = scene.surfaces[at.triangle.surface].monitor;
    if (show != Show::lit) return Vec3(0);
    if (monitor >= 0 && !is_front && !scene.monitors[static_cast<size_t>(monitor)].two_sided) return Vec3(0);
    return emission(scene, lighting.lights, at);
}

}  // namespace

Seen see(const Lighting& lighting, const Vec3& eye, const Vec3& direction, Show show, uint64_t key, size_t pixel,
         std::vector<SeenPoint>& points) {
    const Scene& scene = lighting.scene;
    const Vec3 view = normalize_or(-direction, {0, 0, 1});
    const double length = glm::length(direction);
    Seen seen;
    Vec3 origin = eye;
    double through = 1, travelled = 0;  // share of the ray that goes on; lengths of `direction`
    constexpr int most_layers = 32;     // behind so many panes and unseen back faces nothing is missed
    for (int layer = 0; layer < most_layers && through > 1e-3; ++layer) {
        const auto hit = lighting.rays.closest_hit(origin, direction);
        if (!hit) break;
        const Vec3 position = origin + hit->distance * direction;
        travelled += hit->distance;
        if (hit->triangle.surface >= scene.surfaces.size()) {  // a panel that the configuration describes
            const size_t m = hit->triangle.surface - scene.surfaces.size();
            if (hit->is_front || scene.monitors[m].two_sided) {
                const Vec3 radiance = monitor_emission(scene.monitors[m], lighting.lights[m], position);
                seen.color += through * (show == Show::lit ? radiance : Vec3(1));
            }
            seen.distance = std::min(seen.distance, travelled * length);
            break;
        }
        SurfacePoint at = surface_point(scene, hit->triangle, hit->barycentric);
        const Material& material = material_of(scene, scene.surfaces[at.triangle.surface]);
        const Vec3 front = at.geometric_normal;
        if (hit->is_front || material.double_sided) {
            if (!hit->is_front) at.normal = -at.normal, at.geometric_normal = -at.geometric_normal;
            const bool is_blended = material.alpha_mode == AlphaMode::blend && is_lit_view(show);
            const double opacity = is_blended ? std::clamp(alpha_at(scene, material, at), 0.0, 1.0) : 1;
            const Vec3 emitted = glow(lighting, at, hit->is_front, show);
            SeenPoint point{shading_point(scene, at, view), through * opacity, pixel};
            point.point.key = hash(key, static_cast<uint64_t>(layer));
            point.point.roughness = lighting.settings.roughness.value_or(point.point.roughness);
            seen.color += through * emitted;
            if (!is_lit_view(show)) seen.color += point.weight * view_color(lighting, point.point, show);
            if (opacity > 0.5 && through > 0.5) {
                seen.is_surface = emitted == Vec3(0);
                seen.roughness = seen.is_surface && !point.point.is_unlit ? point.point.roughness : -1;
            }
            if (is_lit_view(show) && point.weight > 0) points.push_back(point);
            seen.distance = std::min(seen.distance, travelled * length);
            through *= 1 - opacity;
        }
        SurfacePoint beyond = at;  // go on from the far side
        beyond.geometric_normal = hit->is_front ? -front : front;
        origin = lighting.rays.ray_origin(beyond);
    }
    return seen;
}

}  // namespace surimi
