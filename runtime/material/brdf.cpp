// SPDX-License-Identifier: Apache-2.0
#include "runtime/material/brdf.h"

#include <algorithm>

#include "runtime/ltc/cone.h"
#include "runtime/ltc/ggx.h"
#include "runtime/ltc/table.h"

namespace surimi {

Brdf brdf_at(const ShadingPoint& point) {
    Brdf brdf;
    const double cosine = std::clamp(glm::dot(point.normal, point.view), ltc_least_cosine, 1.0);
    const Vec3 in_plane = point.view - point.normal * glm::dot(point.normal, point.view);
    const Vec3 any = frame_around(point.normal)[0];
    const Vec3 first = normalize_or(in_plane, any);
    const Vec3 tangent = normalize_or(first - point.normal * glm::dot(point.normal, first), any);
    brdf.frame = Mat3(tangent, glm::cross(point.normal, tangent), point.normal);
    brdf.view = {std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
    brdf.alpha = std::max(ltc_least_alpha, point.roughness * point.roughness);
    brdf.f0 = point.f0;
    const double full = ltc_lobe(point.roughness, cosine, LobePart::full).albedo;
    const double schlick = ltc_lobe(point.roughness, cosine, LobePart::schlick).albedo;
    const Vec3 taken = specular_albedo(point.f0, full, schlick);
    brdf.diffuse_albedo = point.diffuse_albedo * (1.0 - taken);
    const double specular = luminance(taken), diffuse = luminance(brdf.diffuse_albedo);
    // Neither technique is left out where its part exists: the other one would be noise there.
    if (specular > 0) brdf.specular_share = diffuse > 0 ? std::clamp(specular / (specular + diffuse), 0.1, 0.9) : 1;
    return brdf;
}

Parts reflectance(const Brdf& brdf, const Vec3& light) {
    const Vec3 local = light * brdf.frame;  // transposed: into the frame
    if (!(local.z > 0)) return {};
    const Vec3 half = normalize_or(brdf.view + local, {0, 0, 1});
    const double away = std::clamp(1 - glm::dot(brdf.view, half), 0.0, 1.0);
    const double schlick = away * away * away * away * away;
    return {brdf.diffuse_albedo * (local.z / pi),
            (brdf.f0 + (1.0 - brdf.f0) * schlick) * ggx_times_cosine(brdf.alpha, brdf.view, local)};
}

Vec3 sample_direction(const Brdf& brdf, double choice, double u, double v) {
    if (choice < brdf.specular_share) return brdf.frame * sample_ggx(brdf.alpha, brdf.view, u, v);
    const double radius = std::sqrt(u), angle = 2 * pi * v;  // a disk lifted to the hemisphere: density cos / pi
    return brdf.frame * Vec3(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - u));
}

double direction_density(const Brdf& brdf, const Vec3& light) {
    const Vec3 local = light * brdf.frame;
    return brdf.specular_share * ggx_density(brdf.alpha, brdf.view, local) +
           (1 - brdf.specular_share) * std::max(local.z, 0.0) / pi;
}

}  // namespace surimi
