// SPDX-License-Identifier: Apache-2.0
#include "runtime/material/shading_point.h"

#include <algorithm>
#include <optional>

#include "runtime/scene/texture.h"

namespace surimi {
namespace {

/// Directions in which u and v grow on a triangle, orthogonal to the normal; none where the coordinates span no area.
struct TangentFrame {
    Vec3 along_u, along_v;
};

std::optional<TangentFrame> tangent_frame(const Scene& scene, const TextureUse& use, const SurfacePoint& at) {
    const Surface& surface = scene.surfaces[at.triangle.surface];
    if (static_cast<size_t>(use.uv_set) >= surface.uv_sets.size()) return std::nullopt;
    const auto& uvs = surface.uv_sets[static_cast<size_t>(use.uv_set)];
    const auto& [i, j, k] = surface.triangles[at.triangle.triangle];
    const auto mapped = [&](uint32_t vertex) { return Vec2(use.transform * Vec3(uvs[vertex], 1)); };
    const Vec2 a = mapped(j) - mapped(i), b = mapped(k) - mapped(i);
    const double determinant = a.x * b.y - a.y * b.x;
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) return std::nullopt;
    const Vec3 p = surface.positions[j] - surface.positions[i], q = surface.positions[k] - surface.positions[i];
    const Vec3 gradient = std::copysign(1.0, determinant) * (b.y * p - a.y * q);
    const Vec3 in_plane = gradient - at.normal * glm::dot(gradient, at.normal);
    const Vec3 tangent = normalize_or(in_plane, Vec3(0));
    if (tangent == Vec3(0)) return std::nullopt;
    // glTF's v runs down the picture and the map's green up: for a map that is not mirrored the bitangent is N x T.
    // From behind, the whole mapped normal is turned, not the surface's alone.
    const Vec3 front = area_normal(surface.positions[i], surface.positions[j], surface.positions[k]);
    const double side = glm::dot(front, at.geometric_normal) < 0 ? -1 : 1;
    return TangentFrame{side * tangent, std::copysign(1.0, -determinant) * glm::cross(at.normal, tangent)};
}

Vec3 mapped_normal(const Scene& scene, const Material& material, const SurfacePoint& at) {
    const TextureUse& use = material.normal_texture;
    if (use.image < 0 || scene.images[static_cast<size_t>(use.image)].empty()) return at.normal;
    const auto frame = tangent_frame(scene, use, at);
    if (!frame) return at.normal;
    const Vec3 code = 2.0 * Vec3(look_up_texture(scene, use, at)) - 1.0;
    const Vec3 n = normalize_or(
        material.normal_scale * (code.x * frame->along_u + code.y * frame->along_v) + std::max(code.z, 0.0) * at.normal,
        at.normal);
    return glm::dot(n, at.normal) > 0 ? n : at.normal;
}

}  // namespace

Vec3 reflectance_at_normal_incidence(const Material& material, const Vec3& base_color, double metallic) {
    const double n = material.index_of_refraction;
    const double fresnel = n > 0 ? (n - 1) * (n - 1) / ((n + 1) * (n + 1)) : 1;
    const Vec3 dielectric = glm::min(fresnel * material.specular_color, Vec3(1)) * material.specular;
    return glm::mix(dielectric, glm::clamp(base_color, 0.0, 1.0), metallic);
}

bool is_specular(const Material& material) {
    if (material.unlit) return false;
    const bool is_dielectric = material.metallic == 0;
    return !is_dielectric || reflectance_at_normal_incidence(material, Vec3(0), 0) != Vec3(0);
}

ShadingPoint shading_point(const Scene& scene, const SurfacePoint& at, const Vec3& view) {
    const Material& material = material_of(scene, scene.surfaces[at.triangle.surface]);
    const Vec4 roughness_metallic = look_up_texture(scene, material.metallic_roughness_texture, at);
    const Vec3 base_color =
        Vec3(material.base_color) * Vec3(look_up_color_texture(scene, material.base_color_texture, at));
    const double metallic = std::clamp(material.metallic * roughness_metallic.b, 0.0, 1.0);
    ShadingPoint point;
    point.at = at;
    point.view = view;
    point.is_unlit = material.unlit;
    point.normal = mapped_normal(scene, material, at);
    point.roughness = std::clamp(material.roughness * roughness_metallic.g, 0.0, 1.0);
    point.f0 = reflectance_at_normal_incidence(material, base_color, metallic);
    point.diffuse_albedo = base_color * (1 - metallic);
    return point;
}

}  // namespace surimi
