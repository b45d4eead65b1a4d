// SPDX-License-Identifier: Apache-2.0
#include "baker/post/fill.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "baker/post/growth.h"
#include "baker/post/near_texels.h"
#include "baker/post/rim.h"
#include "baker/texel/texel_surface.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr int target_rings = 4;  // texels; bilinear reads at covered texels see one ring, two mip levels four
constexpr int source_rings = 2;  // texels; what lies deeper in a covered region is never nearest
constexpr size_t grain = 256;    // texels that one thread takes at a time

/// One page while it is filled.
struct Page {
    const Texels& texels;
    Channel& channel;
    std::vector<uint32_t> chart;  ///< by texel of the map, as is `owner`
    std::vector<uint32_t> owner;  ///< the chart whose value stands there; no_chart where there is none yet

    Page(const Texels& of, Channel& to)
        : texels(of),
          channel(to),
          chart(to.visibility.pixels.size(), no_chart),
          owner(to.visibility.pixels.size(), no_chart) {
        for (const Texel& texel : texels.texels) {
            chart[texel.index] = texel.chart;
            if (channel.state.pixels[texel.index] == TexelState::covered) owner[texel.index] = texel.chart;
        }
    }

    void give(const Texel& texel, float value) {
        channel.visibility.pixels[texel.index] = value;
        owner[texel.index] = texel.chart;
    }
    void grow_in_charts() { grow(channel.visibility, owner, {.only_chart = chart, .keeps_value = {}}); }
};

/// A texel of a page, by its number in Texels.
struct TexelRef {
    uint32_t page = 0, texel = 0;
};

/// The texels that take part in the exchange of values across the world.
struct Rims {
    std::vector<TexelRef> sources;  ///< covered, at the border of their chart or of what is covered
    std::vector<TexelRef> targets;  ///< others near covered ones, of charts that have such
};

void add_rims(uint32_t number, const Page& page, const std::vector<uint8_t>& has_covered, Rims& rims) {
    std::vector<uint64_t> kinds(page.chart.size());
    std::vector<uint8_t> is_covered(page.chart.size());
    for (size_t i = 0; i < kinds.size(); ++i) {
        kinds[i] = uint64_t{page.chart[i]} << 32 | page.owner[i];
        is_covered[i] = page.owner[i] != no_chart;
    }
    const std::vector<uint8_t> is_source = rim(kinds, page.texels.width, source_rings);
    const std::vector<uint8_t> is_target = spread(std::move(is_covered), page.texels.width, target_rings);
    for (uint32_t t = 0; t < page.texels.texels.size(); ++t) {
        const Texel& texel = page.texels.texels[t];
        if (page.owner[texel.index] != no_chart) {
            if (is_source[texel.index]) rims.sources.push_back({number, t});
        } else if (is_target[texel.index] && has_covered[texel.chart]) {
            rims.targets.push_back({number, t});
        }
    }
}

Rims find_rims(const Atlas& atlas, const std::vector<Page>& pages) {
    std::vector<uint8_t> has_covered(atlas.charts.size(), 0);
    for (const Page& page : pages)
        for (const uint32_t owner : page.owner)
            if (owner != no_chart) has_covered[owner] = 1;
    Rims rims;
    for (uint32_t p = 0; p < pages.size(); ++p) add_rims(p, pages[p], has_covered, rims);
    return rims;
}

std::vector<TexelPlace> places_of(const Scene& scene, const Atlas& atlas, const std::vector<Page>& pages,
                                  const std::vector<TexelRef>& refs) {
    std::vector<TexelPlace> places(refs.size());
    parallel_for(refs.size(), grain, [&](size_t i) {
        const Page& page = pages[refs[i].page];
        const Texel& texel = page.texels.texels[refs[i].texel];
        const SurfacePoint center = TexelSurface(scene, atlas, page.texels, texel).center();
        const double density = atlas.charts[texel.chart].texels_per_metre;
        places[i] = {center.position, center.geometric_normal, density > 0 ? 1 / density : 0, texel.chart,
                     page.channel.visibility.pixels[texel.index]};
    });
    return places;
}

void fill_in_space(const Scene& scene, const Atlas& atlas, std::vector<Page>& pages) {
    const Rims rims = find_rims(atlas, pages);
    if (rims.targets.empty() || rims.sources.empty()) return;
    const NearTexels sources(places_of(scene, atlas, pages, rims.sources));
    const std::vector<TexelPlace> targets = places_of(scene, atlas, pages, rims.targets);
    std::vector<std::optional<float>> values(targets.size());
    parallel_for(targets.size(), grain,
                 [&](size_t i) { values[i] = sources.mean(targets[i], target_rings * targets[i].size); });
    for (size_t i = 0; i < targets.size(); ++i) {
        Page& page = pages[rims.targets[i].page];
        if (values[i]) page.give(page.texels.texels[rims.targets[i].texel], *values[i]);
    }
}

/// Mean of the covered texels of each surface; 1 where there is none.
std::vector<float> surface_means(const Atlas& atlas, const std::vector<Page>& pages) {
    std::vector<double> sum(atlas.surfaces.size(), 0), count(atlas.surfaces.size(), 0);
    for (const Page& page : pages) {
        for (const Texel& texel : page.texels.texels) {
            if (page.channel.state.pixels[texel.index] != TexelState::covered) continue;
            const uint32_t surface = atlas.charts[texel.chart].surface;
            sum[surface] += static_cast<double>(page.channel.visibility.pixels[texel.index]);
            count[surface] += 1;
        }
    }
    std::vector<float> means(atlas.surfaces.size(), 1.f);
    for (size_t s = 0; s < means.size(); ++s)
        if (count[s] > 0) means[s] = static_cast<float>(sum[s] / count[s]);
    return means;
}

/// What lies deep inside other geometry is dark, and beside a texel of which less than half can be seen: reads there
/// that can be seen do not reach across the texel's centre.
void darken_insides(Page& page, int rings) {
    const auto& state = page.channel.state.pixels;
    std::vector<uint8_t> is_read(state.size());
    for (const Texel& texel : page.texels.texels)
        is_read[texel.index] = state[texel.index] == TexelState::covered && texel.is_mostly_free;
    const std::vector<uint8_t> is_near = spread(std::move(is_read), page.texels.width, rings);
    for (const Texel& texel : page.texels.texels)
        if (state[texel.index] == TexelState::inside && !is_near[texel.index]) page.give(texel, 0);
}

}  // namespace

void fill(const Scene& scene, const Atlas& atlas, std::span<const Texels> pages, std::span<Channel> channels,
          const PostSettings& settings) {
    std::vector<Page> all;
    for (size_t p = 0; p < pages.size(); ++p) all.emplace_back(pages[p], channels[p]);
    if (settings.fills_in_space) fill_in_space(scene, atlas, all);
    const std::vector<float> means = surface_means(atlas, all);
    for (Page& page : all) {
        page.grow_in_charts();
        for (const Texel& texel : page.texels.texels)
            if (page.owner[texel.index] == no_chart) page.give(texel, means[atlas.charts[texel.chart].surface]);
        darken_insides(page, std::min(settings.inside_rings, 255));
    }
}

}  // namespace surimi
