// SPDX-License-Identifier: Apache-2.0
#include "runtime/reference/direct_light.h"

#include <optional>

#include "runtime/base/random.h"

namespace surimi {
namespace {

/// Where a sample meets the monitor.
struct LightSample {
    Vec3 direction{0};  ///< unit, from the point
    Vec3 position{0};
    size_t panel = 0;
    double area_density = 0;  ///< of choosing this direction by a point on the monitor, 1/sr; 0 where it does not emit
};

/// Density in 1/sr of directions to points spread evenly over the monitor: r^2 / (A cos).
double area_density(double distance2, double cosine, double area) {
    return cosine > 0 ? distance2 / (area * cosine) : 0;
}

LightSample by_area(const MonitorSampler& sampler, const Vec3& from, double u, double v) {
    const LightPoint to = sampler.sample(u, v);
    const Vec3 offset = to.position - from;
    const double distance2 = glm::dot(offset, offset);
    if (!(distance2 > 0)) return {};
    const Vec3 direction = offset / std::sqrt(distance2);
    const double slope = -glm::dot(direction, to.normal);
    const double cosine = sampler.is_two_sided() ? std::abs(slope) : slope;
    return {direction, to.position, to.panel, area_density(distance2, cosine, sampler.area())};
}

LightSample by_direction(const Monitor& monitor, double area, const Vec3& from, const Vec3& direction,
                         const MonitorHit& hit) {
    const double slope = -glm::dot(direction, front_normal(monitor.panels[hit.panel]));
    const double cosine = monitor.two_sided ? std::abs(slope) : slope;
    return {direction, from + hit.distance * direction, hit.panel,
            area_density(hit.distance * hit.distance, cosine, area)};
}

}  // namespace

DirectLight direct_light(const Scene& scene, const RayScene& rays, size_t monitor, const LitMonitor& light,
                         const MonitorSampler& sampler, const ShadingPoint& point, int samples, bool wants_shadows,
                         uint64_t key) {
    DirectLight sum;
    const Brdf brdf = brdf_at(point);
    const Vec3 from = point.at.position;
    std::optional<Vec3> origin;  // of shadow rays; worked out when the first one is needed
    const auto add = [&](const LightSample& sample) {
        if (!(sample.area_density > 0)) return;
        const Parts r = reflectance(brdf, sample.direction);
        if (r.sum() == Vec3(0)) return;
        const double density = sample.area_density + direction_density(brdf, sample.direction);
        const Vec3 radiance = radiance_at(light, sample.panel, sample.position);
        const Parts share = (radiance / (density * samples)) * r;
        sum.unshadowed += share;
        if (!wants_shadows) return;
        if (!origin) origin = rays.ray_origin(point.at);
        if (!rays.is_occluded(*origin, sample.position, monitor)) sum.shadowed += share;
    };
    const Scrambling for_area = scrambling(hash(key, 0)), for_direction = scrambling(hash(key, 1));
    for (int i = 0; i < samples; ++i) {
        const auto sobol_point = sobol::point(static_cast<uint32_t>(i));
        const auto a = scrambled(sobol_point, for_area), d = scrambled(sobol_point, for_direction);
        add(by_area(sampler, from, a[0], a[1]));
        const Vec3 direction = sample_direction(brdf, d[2], d[0], d[1]);
        for (const MonitorHit& hit : hits_of(scene.monitors[monitor], from, direction))
            add(by_direction(scene.monitors[monitor], sampler.area(), from, direction, hit));
    }
    if (!wants_shadows) sum.shadowed = sum.unshadowed;
    return sum;
}

}  // namespace surimi
