// SPDX-License-Identifier: Apache-2.0
#include "runtime/material/emission.h"

#include <algorithm>

#include "runtime/base/color.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

/// Does a point lie on a panel (in its plane, to 1e-4 of its size)?
bool is_on(const Polygon& panel, const Vec3& point) {
    const Vec3 normal = front_normal(panel);
    const double size = std::sqrt(area(panel));
    if (std::abs(glm::dot(point - panel.corners[0], normal)) > 1e-4 * size) return false;
    for (size_t i = 0; i < panel.corners.size(); ++i) {
        const Vec3& a = panel.corners[i];
        const Vec3& b = panel.corners[(i + 1) % panel.corners.size()];
        if (glm::dot(glm::cross(b - a, point - a), normal) < -1e-4 * size * glm::length(b - a)) return false;
    }
    return true;
}

/// The affine mapping that a triangle's texture coordinates give; none where they or the triangle span no area.
std::optional<PictureMapping> mapping_of(const std::array<Vec3, 3>& p, const std::array<Vec2, 3>& uv) {
    const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], normal = glm::cross(e1, e2);
    const double area2 = glm::dot(normal, normal);
    if (!(area2 > 0)) return std::nullopt;
    // Gradients of the two barycentric coordinates.
    const Vec3 g1 = glm::cross(e2, normal) / area2, g2 = glm::cross(normal, e1) / area2;
    const Vec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    PictureMapping mapping{Vec3(0), d1.x * g1 + d2.x * g2, d1.y * g1 + d2.y * g2};
    const double determinant = d1.x * d2.y - d1.y * d2.x;
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) return std::nullopt;
    const Vec2 share(uv[0].x * d2.y - uv[0].y * d2.x, uv[0].y * d1.x - uv[0].x * d1.y);
    mapping.origin = p[0] - (share.x * e1 + share.y * e2) / determinant;
    return mapping;
}

/// Mappings of all panels of a monitor by the texture coordinates of its surfaces; empty when one has none.
std::vector<PictureMapping> textured_mappings(const Scene& scene, int monitor, const TextureUse& use) {
    std::vector<PictureMapping> mappings;
    for (const Polygon& panel : scene.monitors[static_cast<size_t>(monitor)].panels) {
        std::optional<PictureMapping> found;
        for (const Surface& surface : scene.surfaces) {
            if (surface.monitor != monitor || static_cast<size_t>(use.uv_set) >= surface.uv_sets.size()) continue;
            const auto& uvs = surface.uv_sets[static_cast<size_t>(use.uv_set)];
            for (const auto& corners : surface.triangles) {
                std::array<Vec3, 3> p;
                std::array<Vec2, 3> uv;
                for (size_t k = 0; k < 3; ++k) {
                    p[k] = surface.positions[corners[k]];
                    uv[k] = Vec2(use.transform * Vec3(uvs[corners[k]], 1));
                }
                if (!found && is_on(panel, (p[0] + p[1] + p[2]) / 3.0)) found = mapping_of(p, uv);
            }
        }
        if (!found) return {};
        mappings.push_back(*found);
    }
    return mappings;
}

/// The material of a monitor's first surface; none for one without surfaces.
const Material* monitor_material(const Scene& scene, int monitor) {
    const auto surface = std::find_if(scene.surfaces.begin(), scene.surfaces.end(),
                                      [&](const Surface& s) { return s.monitor == monitor; });
    return surface == scene.surfaces.end() ? nullptr : &material_of(scene, *surface);
}

}  // namespace

Image<Vec3f> linear_image(const Image<glm::u8vec4>& image) {
    Image<Vec3f> linear(image.width, image.height);
    std::transform(image.pixels.begin(), image.pixels.end(), linear.pixels.begin(), [](const glm::u8vec4& p) {
        return Vec3f(linear_from_srgb(p.r / 255.0), linear_from_srgb(p.g / 255.0), linear_from_srgb(p.b / 255.0));
    });
    return linear;
}

std::vector<LitMonitor> lit_monitors(const Scene& scene) {
    std::vector<LitMonitor> lights;
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        LitMonitor light{scene.monitors[m].radiance, std::nullopt};
        const Material* material = monitor_material(scene, static_cast<int>(m));
        if (material && material->emissive != Vec3(0) && material->emissive_texture.image >= 0) {
            const auto& image = scene.images[static_cast<size_t>(material->emissive_texture.image)];
            MonitorPicture picture;
            picture.mappings = textured_mappings(scene, static_cast<int>(m), material->emissive_texture);
            if (!image.empty() && !picture.mappings.empty()) {
                picture.levels = blurred_levels(linear_image(image));
                light.picture = std::move(picture);
            }
        }
        lights.push_back(std::move(light));
    }
    return lights;
}

Vec3 monitor_emission(const Monitor& monitor, const LitMonitor& light, const Vec3& position) {
    if (!light.picture) return light.radiance;
    const std::vector<Polygon>& panels = monitor.panels;
    const auto panel = std::find_if(panels.begin(), panels.end(), [&](const Polygon& p) { return is_on(p, position); });
    if (panel == panels.end()) return light.radiance;
    return radiance_at(light, static_cast<size_t>(panel - panels.begin()), position);
}

Vec3 emission(const Scene& scene, const std::vector<LitMonitor>& lights, const SurfacePoint& at) {
    const Surface& surface = scene.surfaces[at.triangle.surface];
    if (surface.monitor >= 0) {
        const auto m = static_cast<size_t>(surface.monitor);
        return monitor_emission(scene.monitors[m], lights[m], at.position);
    }
    const Material& material = material_of(scene, surface);
    if (material.emissive == Vec3(0)) return Vec3(0);
    return material.emissive * Vec3(look_up_color_texture(scene, material.emissive_texture, at));
}

}  // namespace surimi
