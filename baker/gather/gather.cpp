// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

void GatherStatistics::count(const IrradianceEstimate& estimate, double asked) {
    ++methods[static_cast<size_t>(estimate.method)].texels;
    if (!(estimate.unshadowed > 0)) return;
    const auto error = static_cast<double>(estimate.error);
    const int exponent = error > 0 ? std::ilogb(error) : -bins;  // error < 2^(exponent + 1)
    const int bin = error > 0 ? std::clamp(exponent + bins, 1, bins - 1) : 0;
    ++error_histogram[static_cast<size_t>(bin)];
    if (error > asked) ++above_error;
}

namespace {

/// One call of gather: its blocks, and what became of the texels so far.
struct Gathering {
    const Atlas& atlas;
    const Texels& texels;
    MonitorSetup setup;
    Blocks blocks;
    std::vector<LitTexel> lit;        ///< one for each of Texels::texels
    std::vector<uint32_t> number_at;  ///< of the texel at each place of the map, or `nobody`
    std::vector<GatherStatistics> parts;

    static constexpr uint32_t nobody = 0xffffffffu;
    static constexpr size_t grain = 4;  // blocks; a few milliseconds
};

/// Number of the texel of the same chart `step` further on the map, or `nobody`.
uint32_t mate_of(const Gathering& g, uint32_t number, const glm::ivec2& step) {
    const Texel& texel = g.texels.texels[number];
    const int width = g.texels.width, height = g.texels.height;
    const int x = static_cast<int>(texel.index) % width + step.x, y = static_cast<int>(texel.index) / width + step.y;
    if (x < 0 || y < 0 || x >= width || y >= height) return Gathering::nobody;
    const uint32_t other = g.number_at[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    const bool is_mate = other != Gathering::nobody && g.texels.texels[other].chart == texel.chart;
    return is_mate ? other : Gathering::nobody;
}

constexpr std::array<glm::ivec2, 2> axes = {glm::ivec2(1, 0), glm::ivec2(0, 1)};

bool is_at_border(const Gathering& g, uint32_t number) {
    return std::ranges::any_of(axes, [&](const glm::ivec2& axis) {
        return mate_of(g, number, axis) == Gathering::nobody || mate_of(g, number, -axis) == Gathering::nobody;
    });
}

/// Lights some texels of one block; `footprints` as in light_block.
void light_members(Gathering& g, std::span<const uint32_t> members, std::span<const double> footprints,
                   GatherStatistics& statistics) {
    thread_local BlockWorkspace work;
    std::vector<LitTexel> texels(members.size());
    BlockSurfaces block = block_surfaces(g.setup, g.atlas, g.texels, members);
    for (const uint32_t number : members) block.is_border.push_back(is_at_border(g, number));
    light_block(g.setup, block, footprints, work, texels, statistics);
    for (size_t i = 0; i < members.size(); ++i) g.lit[members[i]] = texels[i];
}

/// footprint_error of a texel by its neighbours on both sides; those that are missing or unlit say nothing.
double footprint_across_tiles(const Gathering& g, const std::vector<float>& visibility, uint32_t number) {
    const auto difference = [&](const glm::ivec2& step) {
        const uint32_t before = mate_of(g, number, -step), after = mate_of(g, number, step);
        if (before == Gathering::nobody || after == Gathering::nobody) return 0.0;
        const auto second =
            static_cast<double>(std::abs(visibility[before] - 2 * visibility[number] + visibility[after]));
        return second >= 0 ? second : 0.0;  // NaN: an unlit neighbour
    };
    return footprint_error({difference(axes[0]), difference(axes[1])},
                           std::max(difference({1, 1}), difference({1, -1})));
}

/// Calls visit(number of the block, its part of the statistics) for all blocks, in parallel.
template <class Visit>
void for_each_block(Gathering& g, const Progress& progress, const Visit& visit) {
    parallel_stage("light from " + g.setup.light().name, g.blocks.count(), Gathering::grain, progress,
                   [&](size_t begin, size_t end) {
                       for (size_t b = begin; b < end; ++b) visit(b, g.parts[begin / Gathering::grain]);
                   });
}

/// Texels at the rim of a tile that were judged by their centre, without the neighbour in the next tile.
void light_rims_again(Gathering& g, const Progress& progress) {
    std::vector<float> visibility(g.lit.size());
    for (size_t i = 0; i < g.lit.size(); ++i) {
        const IrradianceEstimate& e = g.lit[i].estimate;
        visibility[i] = e.unshadowed > 0 ? e.shadowed / e.unshadowed : std::numeric_limits<float>::quiet_NaN();
    }
    const double limit = g.setup.limits.footprint;
    const auto width = static_cast<uint32_t>(g.texels.width);
    const auto is_rim = [&](uint32_t index) {
        const uint32_t x = index % width % tile_size, y = index / width % tile_size;
        return x == 0 || y == 0 || x + 1 == tile_size || y + 1 == tile_size;
    };
    for_each_block(g, progress, [&](size_t b, GatherStatistics& statistics) {
        std::vector<uint32_t> members;
        std::vector<double> footprints;
        for (const uint32_t number : g.blocks[b]) {
            if (!g.lit[number].is_by_center || !is_rim(g.texels.texels[number].index)) continue;
            const double error = footprint_across_tiles(g, visibility, number);
            if (error > limit) members.push_back(number), footprints.push_back(error);
        }
        if (!members.empty()) light_members(g, members, footprints, statistics);
    });
}

}  // namespace

Gathered gather(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays,
                const Silhouettes& silhouettes, size_t monitor, const GatherSettings& settings,
                const Progress& progress) {
    Gathering g{atlas, texels, set_up(scene, rays, silhouettes, monitor, settings), find_blocks(texels), {}, {}, {}};
    g.lit.resize(texels.texels.size());
    g.parts.resize((g.blocks.count() + Gathering::grain - 1) / Gathering::grain);
    g.number_at.assign(static_cast<size_t>(texels.width) * static_cast<size_t>(texels.height), Gathering::nobody);
    for (uint32_t i = 0; i < texels.texels.size(); ++i) g.number_at[texels.texels[i].index] = i;

    for_each_block(g, part_of(progress, 0, 2),
                   [&](size_t b, GatherStatistics& statistics) { light_members(g, g.blocks[b], {}, statistics); });
    light_rims_again(g, part_of(progress, 1, 2));

    Gathered result;
    for (const GatherStatistics& part : g.parts) result.statistics.add(part);
    for (const LitTexel& texel : g.lit) {
        result.estimates.push_back(texel.estimate);
        result.statistics.count(texel.estimate, settings.error);
    }
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
    const PointLight light = light_at(setup, work.sight, point, {settings.seed}, work.point);
    if (segments) *segments = light.segments;
    return {static_cast<float>(light.unshadowed), static_cast<float>(light.shadowed),
            static_cast<float>(light.has_failed ? 1 : light.error), light.method};
}

}  // namespace surimi
