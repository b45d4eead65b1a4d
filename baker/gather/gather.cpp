// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/gather.h"

#include <algorithm>
#include <cmath>

#include "baker/gather/block_light.h"
#include "baker/gather/blocks.h"

namespace surimi {

size_t GatherStatistics::rays() const {
    size_t sum = 0;
    for (const OfMethod& method : methods) sum += method.rays;
    return sum;
}

void GatherStatistics::add(const GatherStatistics& other) {
    for (size_t i = 0; i < methods.size(); ++i) {
        methods[i].texels += other.methods[i].texels;
        methods[i].points += other.methods[i].points;
        methods[i].rays += other.methods[i].rays;
        methods[i].seconds += other.methods[i].seconds;
    }
    blocks += other.blocks;
    shadowed_blocks += other.shadowed_blocks;
    open_blocks += other.open_blocks;
    candidates += other.candidates;
    segments += other.segments;
    failed_checks += other.failed_checks;
    refined_texels += other.refined_texels;
    query_seconds += other.query_seconds;
    for (size_t i = 0; i < error_histogram.size(); ++i) error_histogram[i] += other.error_histogram[i];
    above_error += other.above_error;
}

void GatherStatistics::count_error(double error, double asked) {
    const int exponent = error > 0 ? std::ilogb(error) : -bins;  // error < 2^(exponent + 1)
    const int bin = error > 0 ? std::clamp(exponent + bins, 1, bins - 1) : 0;
    ++error_histogram[static_cast<size_t>(bin)];
    if (error > asked) ++above_error;
}

Gathered gather(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays,
                const Silhouettes& silhouettes, size_t monitor, const GatherSettings& settings,
                const Progress& progress) {
    const MonitorSetup setup = set_up(scene, rays, silhouettes, monitor, settings);
    const Blocks blocks = find_blocks(texels);
    constexpr size_t grain = 4;  // blocks; a few milliseconds
    Gathered result;
    result.estimates.resize(texels.texels.size());
    std::vector<GatherStatistics> statistics((blocks.count() + grain - 1) / grain);
    parallel_stage("light from " + setup.light().name, blocks.count(), grain, progress, [&](size_t begin, size_t end) {
        thread_local BlockWorkspace work;
        std::vector<IrradianceEstimate> estimates;
        for (size_t b = begin; b < end; ++b) {
            const std::span<const uint32_t> members = blocks[b];
            estimates.assign(members.size(), {});
            light_block(setup, block_surfaces(scene, atlas, texels, rays, members), work, estimates,
                        statistics[begin / grain]);
            for (size_t i = 0; i < members.size(); ++i) result.estimates[members[i]] = estimates[i];
        }
    });
    for (const GatherStatistics& part : statistics) result.statistics.add(part);
    return result;
}

IrradianceEstimate irradiance_at(const Scene& scene, const RayScene& rays, const Silhouettes& silhouettes,
                                 size_t monitor, const SurfacePoint& point, const GatherSettings& settings,
                                 size_t* segments) {
    GatherSettings of_point = settings;
    if (settings.method == Method::automatic && !settings.is_exact) of_point.method = Method::scanline;
    const MonitorSetup setup = set_up(scene, rays, silhouettes, monitor, of_point);
    BlockWorkspace work;
    const Vec3 origin = rays.ray_origin(point) - rays.center();
    look_from(work.sight, setup, std::span(&origin, 1), 0);
    const PointLight light = light_at(setup, work.sight, point, settings.seed, work.point);
    if (segments) *segments = light.segments;
    return {static_cast<float>(light.unshadowed), static_cast<float>(light.shadowed),
            static_cast<float>(light.has_failed ? 1 : light.error), light.method};
}

}  // namespace surimi
