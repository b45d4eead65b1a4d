// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/enclosure.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

constexpr uint32_t monitor_rays = 8;
constexpr uint32_t probe_rays = 32;
// Legs without caps and sofas without undersides enclose what is in them but for a few directions; three walls that
// are seen from behind enclose seven eighths.
constexpr uint32_t most_outside = 3;
// Half of them beside a sheet, half of those where it is short.
constexpr uint32_t fewest_backs = 8;
constexpr double reach = 1.5;     // texels: what a bilinear read of the other side of a sheet can meet
constexpr double crevice = 0.25;  // texels: narrower than the map can show

/// Direction i of a scrambled set over the hemisphere, by cosine: near the surface itself little is told.
Vec3 probe_direction(const Vec3& normal, uint32_t i, const Scrambling& seeds) {
    const auto r = scrambled(sobol::point(i), seeds);
    const double radius = std::sqrt(r[0]), angle = 2 * M_PI * r[1];
    const Vec3 other = std::abs(normal.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(glm::cross(normal, other)), v = glm::cross(normal, u);
    return radius * std::cos(angle) * u + radius * std::sin(angle) * v + std::sqrt(1 - r[0]) * normal;
}

/// Does a walk from face to face find a way out of the scene?
bool leaves(const RayScene& rays, Vec3 origin, Vec3 direction, uint64_t key) {
    constexpr uint32_t most_steps = 8;
    const Scrambling seeds = scrambling(key);
    for (uint32_t i = 0; i < most_steps; ++i) {
        const auto hit = rays.closest_hit(origin, direction);
        if (!hit) return true;
        const auto corners = rays.corners_of(hit->triangle);
        const Vec3 normal = normalize_or(area_normal(corners[0], corners[1], corners[2]), -direction);
        const Vec3 front = glm::dot(normal, direction) < 0 ? normal : -normal;
        origin += hit->distance * direction;
        const double rounding = 1e-5 * (hit->distance + largest_component(origin - rays.center()));
        origin += rounding * front;
        direction = probe_direction(front, i, seeds);
    }
    return false;
}

}  // namespace

EnclosureJudge::EnclosureJudge(const Scene& scene, const RayScene& rays) : scene_(scene), rays_(rays) {
    for (const Monitor& monitor : scene.monitors) samplers_.emplace_back(monitor);
    look_from_monitors();
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

bool EnclosureJudge::is_single_sided(uint32_t surface) const {
    const Surface& of = scene_.surfaces[surface];
    return !of.is_two_sided && !material_of(scene_, of).double_sided;
}

Enclosure EnclosureJudge::judge(const SurfacePoint& point, double texel_size, uint64_t key) const {
    return judge(point, {texel_size, key, false});
}

Enclosure EnclosureJudge::judge_back(const SurfacePoint& turned_point, double texel_size, uint64_t key) const {
    return judge(turned_point, {texel_size, key, true});
}

Enclosure EnclosureJudge::judge(const SurfacePoint& point, const Probe& probe) const {
    const auto& [texel_size, key, meets_sheets] = probe;
    if (sees_monitor(point, key)) return Enclosure::free;
    const Vec3 origin = rays_.ray_origin(point);
    const Scrambling seeds = scrambling(hash(key, samplers_.size()));
    uint32_t outside = 0, backs = 0;
    double nearest = INFINITY;
    for (uint32_t i = 0; i < probe_rays; ++i) {
        const Way way = rays_.follow(origin, probe_direction(point.geometric_normal, i, seeds), meets_sheets);
        const bool is_enclosed =
            way.comes_out || (is_closed_ && way.meets_nothing) || way.distance < crevice * texel_size;
        if (!is_enclosed) ++outside;
        if (way.meets_back && is_single_sided(way.surface)) {
            ++backs;
            nearest = std::min(nearest, way.distance);
        }
        if (outside > most_outside && i >= probe_rays / 4 && backs == 0) return Enclosure::free;
    }
    if (outside <= most_outside) return Enclosure::enclosed;
    if (backs < fewest_backs) return Enclosure::free;
    return nearest < reach * texel_size ? Enclosure::enclosed : Enclosure::behind_sheet;
}

void EnclosureJudge::look_from_monitors() {
    constexpr uint32_t count = 64;  // rays of each monitor
    uint32_t inside = 0, leaving = 0, all = 0;
    for (const MonitorSampler& sampler : samplers_) {
        const Scrambling seeds = scrambling(all);
        // Off the panel by some of its width, or rays would meet what it is let into.
        const double step = std::sqrt(sampler.area()) / 64;
        for (uint32_t i = 0; i < count; ++i, ++all) {
            const auto r = scrambled(sobol::point(i), seeds);
            const LightPoint light = sampler.sample(r[2], r[3]);
            const Vec3 origin = light.position + step * light.normal,
                       direction = probe_direction(light.normal, i, seeds);
            inside += rays_.follow(origin, direction).comes_out ? 1 : 0;
            leaving += leaves(rays_, origin, direction, hash(all)) ? 1 : 0;
        }
    }
    is_reliable_ = 2 * inside <= all;
    is_closed_ = all > 0 && 64 * leaving < all;
}

}  // namespace surimi
