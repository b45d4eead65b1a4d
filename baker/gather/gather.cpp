// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "baker/gather/block_light.h"
#include "baker/gather/blocks.h"
#include "baker/gather/downsample.h"
#include "baker/gather/exposure.h"

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

/// What a band sees around it: tiles above it, lit already, and below it. The first tile below is lit with the band,
/// whose rim it may change, and the second one tells where charts end.
constexpr int tiles_above = 1, tiles_below = 2;

/// One band of rows: its blocks, and what became of the texels so far.
struct Gathering {
    const Atlas& atlas;
    const Texels& texels;  ///< of the rows at hand
    const MonitorSetup& setup;
    Rows at_hand;
    Blocks blocks;
    std::vector<LitTexel> lit;        ///< one for each of `texels`
    std::vector<uint32_t> number_at;  ///< of the texel at each place of the rows at hand, or `nobody`
    std::vector<GatherStatistics> parts;

    static constexpr uint32_t nobody = 0xffffffffu;
    static constexpr size_t grain = 4;  // blocks; a few milliseconds

    size_t first_index() const { return static_cast<size_t>(at_hand.begin) * static_cast<size_t>(texels.width); }
    size_t place(int x, int y) const {
        return static_cast<size_t>(y - at_hand.begin) * static_cast<size_t>(texels.width) + static_cast<size_t>(x);
    }
};

/// Number of the texel of the same chart `step` further on the map, or `nobody`.
uint32_t mate_of(const Gathering& g, uint32_t number, const glm::ivec2& step) {
    const Texel& texel = g.texels.texels[number];
    const auto width = static_cast<uint32_t>(g.texels.width);
    const int x = static_cast<int>(texel.index % width) + step.x, y = static_cast<int>(texel.index / width) + step.y;
    if (x < 0 || y < g.at_hand.begin || x >= g.texels.width || y >= g.at_hand.end) return Gathering::nobody;
    const uint32_t other = g.number_at[g.place(x, y)];
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

/// Calls visit(number of the block, its part of the statistics) for all blocks of these texels, in parallel. Rows of
/// tiles are whole among the numbers, so a block's first texel speaks for it.
template <class Visit>
void for_each_block(Gathering& g, const Numbers& numbers, const Progress& progress, const Visit& visit) {
    parallel_stage("light from " + g.setup.light().name, g.blocks.count(), Gathering::grain, progress,
                   [&](size_t begin, size_t end) {
                       for (size_t b = begin; b < end; ++b)
                           if (g.blocks[b].front() >= numbers.begin && g.blocks[b].front() < numbers.end)
                               visit(b, g.parts[begin / Gathering::grain]);
                   });
}

/// Texels at the rim of a tile that were judged by their centre, without the neighbour in the next tile.
void light_rims_again(Gathering& g, const Numbers& numbers, const Progress& progress) {
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
    for_each_block(g, numbers, progress, [&](size_t b, GatherStatistics& statistics) {
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

/// Gathers band after band of a page. The last tile of a band and the first one of the next are neighbours across the
/// bands' border: what became of them is carried on.
class Bands {
  public:
    Bands(const Atlas& atlas, const MonitorSetup& setup) : atlas_(atlas), setup_(setup) {}

    /// Estimates of the texels in `rows`, which follow those of the last call. `texels` has them and those around.
    Gathered next(const Texels& texels, const Rows& rows, const Progress& progress) {
        const Rows at_hand = rows_around(rows, texels.height);
        Gathering g{atlas_, texels, setup_, at_hand, find_blocks(texels), std::exchange(carried_, {}), {}, {}};
        const size_t carried = g.lit.size();
        const Numbers own = numbers_in(texels, rows);
        const Numbers border = numbers_in(texels, {rows.end - tile_size, rows.end + tile_size});
        g.lit.resize(texels.texels.size());
        g.parts.resize((g.blocks.count() + Gathering::grain - 1) / Gathering::grain);
        g.number_at.assign(g.place(0, at_hand.end), Gathering::nobody);
        for (const uint32_t i : g.blocks.order) g.number_at[texels.texels[i].index - g.first_index()] = i;

        for_each_block(g, {carried, border.end}, part_of(progress, 0, 2),
                       [&](size_t b, GatherStatistics& statistics) { light_members(g, g.blocks[b], {}, statistics); });
        if (rows.end < texels.height) {
            const std::span lit(g.lit);
            const auto both = lit.subspan(border.begin, border.count());
            carried_.assign(both.begin(), both.end());
        }
        light_rims_again(g, own, part_of(progress, 1, 2));

        Gathered result;
        for (const GatherStatistics& part : g.parts) result.statistics.add(part);
        result.estimates.reserve(own.count());
        for (size_t i = own.begin; i < own.end; ++i) result.estimates.push_back(g.lit[i].estimate);
        return result;
    }

    static Rows rows_around(const Rows& rows, int height) {
        return {std::max(0, rows.begin - tiles_above * tile_size),
                std::min(height, rows.end + tiles_below * tile_size)};
    }

  private:
    const Atlas& atlas_;
    const MonitorSetup& setup_;
    std::vector<LitTexel> carried_;  // of the last tile of the last band and of the tile below it
};

}  // namespace

int rows_of_band(int width, const GatherSettings& settings) {
    if (settings.band_rows > 0) return settings.band_rows;
    constexpr int subtexels = 1 << 20;
    const int of_row = width * settings.supersample * settings.supersample;
    return std::max(1, subtexels / of_row / tile_size) * tile_size;
}

size_t band_bytes(const Texels& texels, const GatherSettings& settings) {
    if (texels.texels.empty()) return 0;
    const int step = rows_of_band(texels.width, settings);
    size_t most = 0;  // texels of a band and around it
    for (int begin = 0; begin < texels.height; begin += step) {
        const Rows rows{begin, begin + step};
        most = std::max(most, numbers_in(texels, Bands::rows_around(rows, texels.height)).count());
    }
    const auto side = static_cast<size_t>(settings.supersample);
    const size_t rows = std::min(static_cast<size_t>(texels.height),
                                 static_cast<size_t>(step + (tiles_above + tiles_below) * tile_size));
    const size_t triangles = sizeof(TriangleRef) * texels.triangles.size() / texels.texels.size();
    const size_t of_texel = sizeof(Texel) + triangles;
    const size_t of_subtexel = of_texel + sizeof(LitTexel) + 2 * sizeof(uint32_t) + sizeof(IrradianceEstimate) +
                               sizeof(GatherStatistics) / (Gathering::grain * tile_size * tile_size);
    const size_t places = rows * static_cast<size_t>(texels.width) * side * side;
    return places * sizeof(uint32_t) + most * (side * side * of_subtexel + (side > 1 ? of_texel : 0));
}

Gathered gather(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays,
                const Silhouettes& silhouettes, size_t monitor, const GatherSettings& settings,
                const Progress& progress) {
    const MonitorSetup setup = set_up(scene, rays, silhouettes, monitor, settings);
    const int side = settings.supersample, step = rows_of_band(texels.width, settings);
    static_assert(largest_supersample <= most_subdivided);
    std::optional<Atlas> fine;
    if (side > 1) {
        fine = atlas;
        fine->width *= side;
        fine->height *= side;
    }
    Bands bands(fine ? *fine : atlas, setup);
    Gathered result;
    result.estimates.reserve(texels.texels.size());
    const auto count = static_cast<size_t>((texels.height + step - 1) / step);
    for (size_t band = 0; band < count; ++band) {
        const int begin = static_cast<int>(band) * step;
        const Rows rows{begin, std::min(begin + step, texels.height)};
        const Texels around = texels_in(texels, Bands::rows_around(rows, texels.height));
        const Progress of_band = part_of(progress, band, count);
        Gathered part;
        if (fine) {
            const Rows sub{side * rows.begin, side * rows.end};
            Texels subtexels = subdivided(around, *fine, Bands::rows_around(sub, fine->height));
            expose_parts(scene, *fine, rays, subtexels, side);
            part = bands.next(subtexels, sub, of_band);
            const Texels own = texels_in(subtexels, sub);
            part.estimates = downsample({scene, *fine, own, rays}, texels_in(around, rows), part.estimates);
        } else {
            part = bands.next(around, rows, of_band);
        }
        result.statistics.add(part.statistics);
        result.estimates.insert(result.estimates.end(), part.estimates.begin(), part.estimates.end());
    }
    for (const IrradianceEstimate& estimate : result.estimates) result.statistics.count(estimate, settings.error);
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
