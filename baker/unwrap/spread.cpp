// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/spread.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

/// What lies on a page so far.
struct Page {
    double load = 0;  ///< texels
    std::set<int> nodes;
    std::set<int> materials;

    int kinship(const Surface& surface) const {
        return 2 * static_cast<int>(nodes.count(surface.node)) + static_cast<int>(materials.count(surface.material));
    }
};

/// The emptiest page, or one that holds kin and that the surface does not fill beyond its share.
size_t choose_page(const std::vector<Page>& pages, const Surface& surface, double need, double share) {
    const auto rank = [&](const Page& page) {
        return std::pair(page.load + need <= share ? -page.kinship(surface) : 0, page.load);
    };
    const auto best =
        std::min_element(pages.begin(), pages.end(), [&](const Page& l, const Page& r) { return rank(l) < rank(r); });
    return static_cast<size_t>(best - pages.begin());
}

/// Numbers the pages in use by their first surfaces; surfaces without charts, -1, go to the first.
void renumber(std::vector<int>& page_of_surface, size_t page_count) {
    std::vector<int> numbers(page_count, -1);
    int next = 0;
    for (int& page : page_of_surface) {
        if (page < 0) continue;
        int& number = numbers[static_cast<size_t>(page)];
        if (number < 0) number = next++;
        page = number;
    }
    std::replace(page_of_surface.begin(), page_of_surface.end(), -1, 0);
}

/// What pages hold.
struct Contents {
    Need need;
    int surfaces = 0;  ///< with charts
};

std::vector<Contents> contents_of(const Pages& pages, const std::vector<Need>& needs) {
    std::vector<Contents> contents(pages.densities.size());
    for (size_t s = 0; s < needs.size(); ++s) {
        if (!(needs[s].always > 0)) continue;
        Contents& page = contents[static_cast<size_t>(pages.of_surface[s])];
        page.need += needs[s];
        ++page.surfaces;
    }
    return contents;
}

}  // namespace

Need& Need::operator+=(const Need& other) {
    per_square += other.per_square;
    per_metre += other.per_metre;
    always += other.always;
    return *this;
}

Need& Need::operator-=(const Need& other) {
    per_square -= other.per_square;
    per_metre -= other.per_metre;
    always -= other.always;
    return *this;
}

double density_of(const Need& need, double texels) {
    if (!(need.per_square > 0) || texels <= need.always) return 0;
    const double half = 0.5 * need.per_metre;
    return (std::sqrt(half * half + need.per_square * (texels - need.always)) - half) / need.per_square;
}

std::vector<Need> needs_of_surfaces(size_t surface_count, const FitRequest& request) {
    std::vector<Need> needs(surface_count);
    const double margin = request.gutter + 1;
    for (size_t i = 0; i < request.charts.size(); ++i) {
        const FlatChart& chart = request.charts[i];
        const double factor = request.factors[i];
        const double across = chart.is_sliver ? 0 : chart.extent.x + chart.extent.y;
        needs[chart.surface] += {chart.area * factor * factor, across * factor * margin, margin * margin};
    }
    return needs;
}

std::vector<int> spread_over_pages(const Scene& scene, const std::vector<Need>& needs, const UnwrapSettings& settings) {
    Need total;
    for (const Need& need : needs) total += need;
    constexpr double usual_fill = 0.85;  // of a map, by packing
    const double room = usual_fill * settings.atlases * settings.width * settings.height;
    const double density = settings.texels_per_metre > 0 ? settings.texels_per_metre : density_of(total, room);
    const double share = total.at(density) / settings.atlases;

    std::vector<uint32_t> order;
    for (uint32_t s = 0; s < needs.size(); ++s)
        if (needs[s].always > 0) order.push_back(s);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t l, uint32_t r) { return needs[l].at(density) > needs[r].at(density); });
    std::vector<Page> pages(std::min(static_cast<size_t>(settings.atlases), order.size()));
    std::vector<int> page_of_surface(needs.size(), -1);
    for (const uint32_t s : order) {
        const Surface& surface = scene.surfaces[s];
        const double need = needs[s].at(density);
        const size_t chosen = choose_page(pages, surface, need, share);
        pages[chosen].load += need;
        pages[chosen].nodes.insert(surface.node);
        pages[chosen].materials.insert(surface.material);
        page_of_surface[s] = static_cast<int>(chosen);
    }
    renumber(page_of_surface, pages.size());
    return page_of_surface;
}

int tightest_page(const Pages& pages, const std::vector<Need>& needs) {
    const std::vector<Contents> contents = contents_of(pages, needs);
    int tightest = -1;
    for (size_t p = 0; p < contents.size(); ++p)
        if (contents[p].surfaces > 1 &&
            (tightest < 0 || pages.densities[p] < pages.densities[static_cast<size_t>(tightest)]))
            tightest = static_cast<int>(p);
    return tightest;
}

std::optional<Move> best_move(const Pages& pages, const std::vector<Need>& needs, const std::set<Move>& excluded) {
    const int tightest = tightest_page(pages, needs);
    if (tightest < 0) return std::nullopt;
    const std::vector<Contents> contents = contents_of(pages, needs);
    const auto density_with = [&](int page, const Need& need) {
        const auto p = static_cast<size_t>(page);
        return density_of(need, contents[p].need.at(pages.densities[p]));
    };
    const Contents& from = contents[static_cast<size_t>(tightest)];
    constexpr double least_gain = 1.005;  // less is within what packing varies
    double best = least_gain * pages.densities[static_cast<size_t>(tightest)];
    std::optional<Move> move;
    for (uint32_t s = 0; s < needs.size(); ++s) {
        if (pages.of_surface[s] != tightest || !(needs[s].always > 0)) continue;
        Need rest = from.need;
        rest -= needs[s];
        // A surface that is left alone holds up nobody.
        const double left = from.surfaces == 2 ? INFINITY : density_with(tightest, rest);
        for (int to = 0; to < static_cast<int>(contents.size()); ++to) {
            if (to == tightest || excluded.count({s, to}) > 0) continue;
            Need more = contents[static_cast<size_t>(to)].need;
            more += needs[s];
            const double lowest = std::min(left, density_with(to, more));
            if (lowest <= best) continue;
            best = lowest;
            move = Move{s, to};
        }
    }
    return move;
}

}  // namespace surimi
