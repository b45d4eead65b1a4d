// SPDX-License-Identifier: Apache-2.0
#include "runtime/shade/plan.h"

#include <algorithm>

#include "runtime/material/shading_point.h"

namespace surimi {

ShadingPlan plan_shading(const Scene& scene, const std::vector<LitMonitor>& lights,
                         const std::vector<VisibilityMap>& pages) {
    ShadingPlan plan;
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        MonitorPlan monitor;
        monitor.is_lit = is_lit(lights[m]);
        monitor.has_picture = lights[m].picture.has_value();
        float darkest = 1;
        size_t dark = 0;
        size_t texels = 0;
        for (const VisibilityMap& page : pages) {
            texels += page.visibility.pixels.size();
            for (const Vec3f& v : page.visibility.pixels) {
                const float own = v[scene.monitors[m].channel];
                darkest = std::min(darkest, own);
                dark += own == 0;
            }
        }
        monitor.darkest = static_cast<double>(darkest);
        monitor.is_ever_blocked = darkest < 1;
        monitor.dark_share = static_cast<double>(dark) / static_cast<double>(std::max<size_t>(1, texels));
        plan.monitors.push_back(monitor);
    }
    for (const Material& material : scene.materials) {
        plan.is_specular.push_back(is_specular(material));
        const bool is_metal = material.metallic == 1 && material.metallic_roughness_texture.image < 0;
        plan.is_diffuse.push_back(!material.unlit && !is_metal);
    }
    return plan;
}

MonitorCounts& MonitorCounts::operator+=(const MonitorCounts& other) {
    points += other.points;
    unseen += other.unseen;
    dark += other.dark;
    diffuse += other.diffuse;
    specular += other.specular;
    schlick += other.schlick;
    map_reads += other.map_reads;
    not_finite += other.not_finite;
    return *this;
}

}  // namespace surimi
