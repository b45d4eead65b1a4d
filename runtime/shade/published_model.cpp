// SPDX-License-Identifier: Apache-2.0
#include "runtime/shade/published_model.h"

#include <algorithm>

#include "runtime/shade/published.h"
#include "runtime/visibility/baked.h"

namespace surimi {
namespace {

/// The panel as quads that fan out from its first corner; the last of an odd number of triangles repeats a corner.
std::vector<std::array<Vec3f, 4>> quads_of(const Polygon& panel) {
    std::vector<std::array<Vec3f, 4>> quads;
    const std::vector<Vec3>& c = panel.corners;
    for (size_t i = 1; i + 1 < c.size(); i += 2)
        quads.push_back({Vec3f(c[0]), Vec3f(c[i]), Vec3f(c[i + 1]), Vec3f(c[std::min(i + 2, c.size() - 1)])});
    return quads;
}

/// three.js shades nothing smoother than this, as Filament does on desktops (r187; 0.0525 before).
constexpr double three_least_roughness = 0.045;

float shown_roughness(double roughness, ShadingModel model) {
    return static_cast<float>(model == ShadingModel::three ? std::max(roughness, three_least_roughness) : roughness);
}

Parts parts_of(const published::Shares& shares, const ShadingPoint& point, ShadingModel model) {
    // Unity's metallic workflow keeps 4 % of the diffuse albedo back for the dielectric's reflection.
    const double kept = model == ShadingModel::kanikama ? 0.96 : 1;
    const Vec3 mirrored =
        specular_albedo(point.f0, static_cast<double>(shares.albedo), static_cast<double>(shares.fresnel));
    return {kept * point.diffuse_albedo * static_cast<double>(shares.diffuse),
            mirrored * static_cast<double>(shares.specular)};
}

}  // namespace

void shade_as_published(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
                        std::span<MonitorCounts> counts) {
    const published::Proxy proxy =
        lighting.settings.model == ShadingModel::kanikama ? published::Proxy::table : published::Proxy::fraction;
    const bool is_baked = lighting.settings.visibility == VisibilitySource::baked;
    for (size_t m = 0; m < lighting.scene.monitors.size(); ++m) {
        const Monitor& monitor = lighting.scene.monitors[m];
        std::vector<std::array<Vec3f, 4>> quads;
        for (const Polygon& panel : monitor.panels)
            for (const auto& quad : quads_of(panel)) quads.push_back(quad);
        counts[m].points += points.size();
        for (size_t i = 0; i < points.size(); ++i) {
            const ShadingPoint& point = points[i];
            const Surface& surface = lighting.scene.surfaces[point.at.triangle.surface];
            if (point.is_unlit || surface.monitor == static_cast<int>(m)) {
                ++counts[m].unseen;
                continue;
            }
            const float roughness = shown_roughness(point.roughness, lighting.settings.model);
            Parts sum;
            for (const auto& quad : quads)
                sum += parts_of(published::clipless_quad(quad.data(), Vec3f(point.at.position), Vec3f(point.normal),
                                                         Vec3f(point.view), roughness, proxy),
                                point, lighting.settings.model);
            ++counts[m].diffuse;
            ++counts[m].specular;
            counts[m].map_reads += is_baked;
            const double v =
                is_baked ? baked_visibility(lighting.scene, lighting.pages, point.at)[monitor.channel] : 1.0;
            if (is_finite(sum.diffuse) && is_finite(sum.specular))
                reflected[i] += (lighting.lights[m].radiance * v) * sum;
            else
                ++counts[m].not_finite;
        }
    }
}

}  // namespace surimi
