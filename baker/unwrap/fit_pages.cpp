// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/fit_pages.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace surimi {
namespace {

/// The charts of one page, and their numbers among all.
struct PageCharts {
    std::vector<FlatChart> charts;
    std::vector<double> factors;
    std::vector<size_t> numbers;
};

PageCharts charts_on(const FitRequest& request, const Pages& pages, size_t page) {
    PageCharts own;
    for (size_t i = 0; i < request.charts.size(); ++i) {
        if (pages.of_surface[request.charts[i].surface] != static_cast<int>(page)) continue;
        own.charts.push_back(request.charts[i]);
        own.factors.push_back(request.factors[i]);
        own.numbers.push_back(i);
    }
    return own;
}

/// Packs pages of one scene, and tells how far that is.
class PagePacker {
  public:
    /// `steps`: how often a page is packed, at most.
    PagePacker(const FitRequest& request, const UnwrapSettings& settings, size_t steps)
        : request_(request), settings_(settings), steps_(steps) {}

    /// `known` above 0: the page's density before a few charts changed.
    Layout pack(const Pages& pages, size_t page, double known) {
        return packed(pages, page, [&](const FitRequest& own) {
            if (settings_.texels_per_metre > 0) return fit_to_density(own, settings_.texels_per_metre);
            const MapSize map{settings_.width, settings_.height};
            return known > 0 ? fit_near(own, map, known) : fit_to_map(own, map);
        });
    }

    /// Packs what is known to fit at about `density`.
    Layout pack_near(const Pages& pages, size_t page, const MapSize& map, double density) {
        return packed(pages, page, [&](const FitRequest& own) { return fit_near(own, map, density); });
    }

  private:
    template <class Fit>
    Layout packed(const Pages& pages, size_t page, const Fit& fit) {
        const Progress progress = part_of(request_.progress, std::min(done_++, steps_ - 1), steps_);
        if (pages.densities.size() == 1)
            return fit({request_.charts, request_.factors, request_.gutter, progress, request_.mips, request_.effort});
        const PageCharts own = charts_on(request_, pages, page);
        return fit({own.charts, own.factors, request_.gutter, progress, request_.mips, request_.effort});
    }

    const FitRequest& request_;
    const UnwrapSettings& settings_;
    size_t steps_ = 1;
    size_t done_ = 0;
};

/// How many moves of a surface are tried.
size_t most_moves(const UnwrapSettings& settings, size_t page_count) {
    if (settings.texels_per_metre > 0 || page_count < 2 || settings.quality == UvQuality::draft) return 0;
    return settings.quality == UvQuality::medium ? page_count : 4 * page_count;
}

/// The density of all pages, unless one holds a single surface and has no room for it.
double common_density(const Pages& pages, const std::vector<Need>& needs) {
    const int tightest = tightest_page(pages, needs);
    if (tightest >= 0) return pages.densities[static_cast<size_t>(tightest)];
    return *std::max_element(pages.densities.begin(), pages.densities.end());
}

void move_surfaces(PagePacker& packer, const std::vector<Need>& needs, size_t moves, Pages& pages,
                   std::vector<Layout>& layouts) {
    std::set<Move> rejected;
    for (size_t i = 0; i < moves; ++i) {
        const std::optional<Move> move = best_move(pages, needs, rejected);
        if (!move) return;
        const auto& [surface, to] = *move;
        Pages changed = pages;
        const int from = std::exchange(changed.of_surface[surface], to);
        std::vector<Layout> pair;
        for (const int page : {from, to}) {
            const auto p = static_cast<size_t>(page);
            pair.push_back(packer.pack(changed, p, 0));
            changed.densities[p] = pair.back().texels_per_metre;
        }
        if (common_density(changed, needs) <= common_density(pages, needs)) {
            rejected.insert(*move);
            continue;
        }
        pages = std::move(changed);
        layouts[static_cast<size_t>(from)] = std::move(pair[0]);
        layouts[static_cast<size_t>(to)] = std::move(pair[1]);
    }
}

/// Packs again what is smaller than the largest page or denser than the others. Returns the common density.
double make_alike(PagePacker& packer, const std::vector<Need>& needs, Pages& pages, std::vector<Layout>& layouts) {
    MapSize map;
    for (const Layout& layout : layouts)
        map = {std::max(map.width, layout.map.width), std::max(map.height, layout.map.height)};
    double density = common_density(pages, needs);
    for (bool is_lower = true; is_lower;) {  // a page may fail where it fitted at a higher density
        is_lower = false;
        for (size_t p = 0; p < layouts.size(); ++p) {
            Layout& layout = layouts[p];
            const bool is_as_large = layout.map.width == map.width && layout.map.height == map.height;
            if (is_as_large && layout.texels_per_metre <= density) continue;
            layout = packer.pack_near(pages, p, map, density);
            pages.densities[p] = layout.texels_per_metre;
            is_lower = is_lower || layout.texels_per_metre < density;
            density = std::min(density, layout.texels_per_metre);
        }
    }
    return density;
}

}  // namespace

Layout fit_pages(const Scene& scene, const FitRequest& request, const UnwrapSettings& settings, Pages& pages) {
    const std::vector<Need> needs = needs_of_surfaces(scene.surfaces.size(), request);
    const bool is_first = pages.of_surface.empty();
    if (is_first) {
        pages.of_surface = spread_over_pages(scene, needs, settings);
        const int last = *std::max_element(pages.of_surface.begin(), pages.of_surface.end());
        pages.densities.assign(static_cast<size_t>(last) + 1, 0);
    }
    const size_t count = pages.densities.size();
    const size_t moves = is_first ? most_moves(settings, count) : 0;
    PagePacker packer(request, settings, count > 1 ? 2 * (count + moves) : 1);
    std::vector<Layout> layouts;
    for (size_t p = 0; p < count; ++p) {
        layouts.push_back(packer.pack(pages, p, pages.densities[p]));
        pages.densities[p] = layouts[p].texels_per_metre;
    }
    if (count == 1) return std::move(layouts[0]);
    move_surfaces(packer, needs, moves, pages, layouts);
    const double density = make_alike(packer, needs, pages, layouts);

    Layout all{layouts[0].map, density, {}, {}};
    all.shapes.resize(request.charts.size());
    all.placements.resize(request.charts.size());
    for (size_t p = 0; p < count; ++p) {
        const std::vector<size_t> numbers = charts_on(request, pages, p).numbers;
        for (size_t i = 0; i < numbers.size(); ++i) {
            all.shapes[numbers[i]] = std::move(layouts[p].shapes[i]);
            all.placements[numbers[i]] = layouts[p].placements[i];
        }
    }
    if (request.progress.report) request.progress.report("packing", 1);
    return all;
}

void mark_full_pages(const std::vector<FlatChart>& charts, const Pages& pages, double texels_per_metre,
                     std::vector<ChartWeight>& weights) {
    for (size_t c = 0; c < charts.size(); ++c) {
        const auto page = static_cast<size_t>(pages.of_surface[charts[c].surface]);
        weights[c].page = std::min(1.0, pages.densities[page] / texels_per_metre);
    }
}

}  // namespace surimi
