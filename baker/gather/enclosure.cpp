// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/enclosure.h"

#include <cmath>

#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr uint32_t monitor_rays = 8;
constexpr uint32_t probe_rays = 32;
// Legs without caps and sofas without undersides enclose what is in them but for a few directions; three walls that
// are seen from behind enclose seven eighths.
constexpr uint32_t most_outside = 3;

/// Direction i of a scrambled set over the hemisphere, by cosine: near the surface itself little is told.
Vec3 probe_direction(const Vec3& normal, uint32_t i, const Scrambling& seeds) {
    const auto r = scrambled(sobol::point(i), seeds);
    const double radius = std::sqrt(r[0]), angle = 2 * M_PI * r[1];
    const Vec3 other = std::abs(normal.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(glm::cross(normal, other)), v = glm::cross(normal, u);
    return radius * std::cos(angle) * u + radius * std::sin(angle) * v + std::sqrt(1 - r[0]) * normal;
}

}  // namespace

EnclosureJudge::EnclosureJudge(const Scene& scene, const RayScene& rays) : scene_(scene), rays_(rays) {
    for (const Monitor& monitor : scene.monitors) samplers_.emplace_back(monitor);
}

bool EnclosureJudge::sees_monitor(const SurfacePoint& point, uint64_t key) const {
    const Vec3 origin = rays_.ray_origin(point);
    for (size_t m = 0; m < samplers_.size(); ++m) {
        const Scrambling seeds = scrambling(hash(key, m));
        for (uint32_t i = 0; i < monitor_rays; ++i) {
            const auto r = scrambled(sobol::point(i), seeds);
            const LightPoint light = samplers_[m].sample(r[0], r[1]);
            const Vec3 way = light.position - origin;
            const bool is_before = samplers_[m].is_two_sided() || glm::dot(way, light.normal) < 0;
            if (is_before && glm::dot(way, point.geometric_normal) > 0 && !rays_.is_occluded(origin, light.position, m))
                return true;
        }
    }
    return false;
}

bool EnclosureJudge::is_enclosed(const SurfacePoint& point, uint64_t key) const {
    if (sees_monitor(point, key)) return false;
    const Vec3 origin = rays_.ray_origin(point);
    const Scrambling seeds = scrambling(hash(key, samplers_.size()));
    uint32_t outside = 0;
    for (uint32_t i = 0; i < probe_rays && outside <= most_outside; ++i)
        if (!rays_.starts_inside(origin, probe_direction(point.geometric_normal, i, seeds))) ++outside;
    return outside <= most_outside;
}

bool EnclosureJudge::is_reliable() const {
    constexpr uint32_t places = 16;
    uint32_t inside = 0, all = 0;
    for (const MonitorSampler& sampler : samplers_) {
        const Scrambling seeds = scrambling(all);
        // As far off the panel as the panel is wide, or rays would meet what it is let into.
        const double step = std::sqrt(sampler.area()) / 64;
        for (uint32_t i = 0; i < places; ++i, ++all) {
            const auto r = scrambled(sobol::point(i), seeds);
            const LightPoint light = sampler.sample(r[2], r[3]);
            if (rays_.starts_inside(light.position + step * light.normal, probe_direction(light.normal, i, seeds)))
                ++inside;
        }
    }
    return 2 * inside <= all;
}

}  // namespace surimi
