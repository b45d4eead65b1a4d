// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/gather.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"
#include "runtime/light/sample.h"
#include "runtime/ltc/polygon.h"

namespace surimi {
namespace {

/// What all texels of one monitor share.
struct Shared {
    const Scene& scene;
    const Atlas& atlas;
    const Texels& texels;
    const RayScene& rays;
    const Monitor& monitor;
    size_t monitor_index;
    MonitorSampler sampler;
    uint64_t seed;
    std::vector<std::array<uint32_t, 4>> sobol;
};

/// Unshadowed irradiance as an average over the first four sample points of the texel: they are one in each quarter,
/// and E changes slowly over a texel.
double unshadowed_irradiance(const Shared& shared, const TexelSurface& surface, const Scrambling& seeds) {
    const size_t count = std::min<size_t>(4, shared.sobol.size());
    double sum = 0;
    for (size_t i = 0; i < count; ++i) {
        const auto r = scrambled(shared.sobol[i], seeds);
        const SurfacePoint point = surface.sample(r[0], r[1]);
        for (const Polygon& panel : shared.monitor.panels)
            sum += irradiance_of_polygon<double>(panel.corners, point.position, point.normal, shared.monitor.two_sided);
    }
    return std::min(sum / static_cast<double>(count), pi);
}

/// Irradiance weight of a monitor point for a surface point, up to the monitor's area: cos cos / r^2.
double transfer(const SurfacePoint& point, const LightPoint& light, bool two_sided) {
    const Vec3 d = light.position - point.position;
    const double r2 = glm::dot(d, d);
    const double receiver = glm::dot(d, point.normal);
    const double emitter = two_sided ? std::abs(glm::dot(d, light.normal)) : -glm::dot(d, light.normal);
    if (!(receiver > 0) || !(emitter > 0)) return 0;
    return receiver * emitter / (r2 * r2);
}

/// The ratio estimator (M6): V = sum w_i v_i / sum w_i over pairs of a texel point and a monitor point. A texel from
/// which nothing is blocked gets exactly 1.
IrradianceEstimate gather_texel(const Shared& shared, const Texel& texel, size_t& rays) {
    const TexelSurface surface(shared.scene, shared.atlas, shared.texels, texel);
    const auto page_size = static_cast<uint64_t>(shared.texels.width) * static_cast<uint64_t>(shared.texels.height);
    const uint64_t key = static_cast<uint64_t>(shared.texels.page) * page_size + texel.index;
    const Scrambling seeds = scrambling(hash(hash(shared.seed, static_cast<uint64_t>(shared.monitor.channel)), key));
    const double unshadowed = unshadowed_irradiance(shared, surface, seeds);
    if (!(unshadowed > 0)) return {};

    double all = 0, seen = 0;                  // sums of w and of w v
    double all_squared = 0, seen_squared = 0;  // sums of w^2 and of w^2 v
    for (const auto& point : shared.sobol) {
        const auto r = scrambled(point, seeds);
        const SurfacePoint from = surface.sample(r[0], r[1]);
        const LightPoint to = shared.sampler.sample(r[2], r[3]);
        const double w = transfer(from, to, shared.monitor.two_sided);
        if (!(w > 0)) continue;
        all += w;
        all_squared += w * w;
        // Light that the shading normal would admit but the surface itself blocks: occluded without a ray.
        if (glm::dot(to.position - from.position, from.geometric_normal) <= 0) continue;
        ++rays;
        if (shared.rays.is_occluded(shared.rays.ray_origin(from), to.position, shared.monitor_index)) continue;
        seen += w;
        seen_squared += w * w;
    }
    if (!(all > 0)) return {};  // a sliver of the monitor above the horizon that no sample met
    const double visibility = seen / all;
    // Variance of the ratio by linearisation (M7), as if samples were independent: stratification only lowers it.
    const double variance = (seen_squared * (1 - 2 * visibility) + all_squared * visibility * visibility) / (all * all);
    return {static_cast<float>(unshadowed), static_cast<float>(unshadowed * visibility),
            static_cast<float>(std::sqrt(std::max(0.0, variance))), TexelMethod::monte_carlo};
}

}  // namespace

size_t GatherStatistics::rays() const {
    size_t sum = 0;
    for (const OfMethod& method : methods) sum += method.rays;
    return sum;
}

Gathered gather(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays, const Silhouettes&,
                size_t monitor, const GatherSettings& settings, const Progress& progress) {
    Shared shared{
        scene,         atlas, texels, rays, scene.monitors[monitor], monitor, MonitorSampler(scene.monitors[monitor]),
        settings.seed, {}};
    for (int i = 0; i < (settings.samples > 0 ? settings.samples : 256); ++i)
        shared.sobol.push_back(sobol::point(static_cast<uint32_t>(i)));

    constexpr size_t grain = 256;  // texels; a few milliseconds of rays
    Gathered result;
    result.estimates.resize(texels.texels.size());
    std::vector<size_t> range_rays((texels.texels.size() + grain - 1) / grain, 0);
    parallel_stage("light from " + scene.monitors[monitor].name, texels.texels.size(), grain, progress,
                   [&](size_t begin, size_t end) {
                       for (size_t i = begin; i < end; ++i)
                           result.estimates[i] = gather_texel(shared, texels.texels[i], range_rays[begin / grain]);
                   });
    for (const size_t count : range_rays)
        result.statistics.methods[static_cast<size_t>(TexelMethod::monte_carlo)].rays += count;
    return result;
}

}  // namespace surimi
