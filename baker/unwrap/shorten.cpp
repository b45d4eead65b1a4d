// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/shorten.h"

#include <algorithm>

#include "baker/unwrap/seam_cost.h"
#include "baker/unwrap/walk.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

/// The share of the map that charts fill, about.
constexpr double filled_share = 0.8;
/// Charts up to this share of the map's side leave the packer its freedom.
constexpr double easy_length = 0.9;
constexpr uint32_t most_parts = 8;

/// How far along its longer direction each triangle lies, from 0 to 1: along the box of a compact chart, along the
/// surface in a bent one.
std::vector<double> progress_along(const FlatChart& chart, const std::vector<std::array<uint32_t, 3>>& neighbours,
                                   bool is_bent) {
    const auto count = static_cast<uint32_t>(chart.triangles.size());
    std::vector<double> along(count);
    const std::vector<Vec3> centroids = centroids_of(chart);
    const glm::length_t axis = chart.extent.x >= chart.extent.y ? 0 : 1;
    for (uint32_t t = 0; t < count; ++t) along[t] = centroids[t][axis] / chart.extent[axis];
    if (!is_bent) return along;
    const uint32_t end = walk_from({0}, neighbours, centroids).last;
    const Walk walk = walk_from({end}, neighbours, centroids);
    const auto whole = static_cast<double>(walk.distance[walk.last]);
    for (uint32_t t = 0; t < count; ++t) along[t] = whole > 0 ? static_cast<double>(walk.distance[t]) / whole : 0;
    return along;
}

/// Pieces of a part that are much smaller than the parts join the neighbour with which they share most edges.
void give_crumbs_away(const FaceGraph& graph, const FlatChart& chart,
                      const std::vector<std::array<uint32_t, 3>>& neighbours, std::vector<uint32_t>& parts) {
    const uint32_t part_count = *std::max_element(parts.begin(), parts.end()) + 1;
    constexpr double crumb_share = 0.2;
    const double crumb = crumb_share * chart.area / part_count;
    std::vector<bool> is_seen(parts.size(), false);
    for (uint32_t start = 0; start < parts.size(); ++start) {
        if (is_seen[start]) continue;
        is_seen[start] = true;
        std::vector<uint32_t> piece{start};
        std::vector<uint32_t> shared(part_count, 0);
        double area = 0;
        for (size_t i = 0; i < piece.size(); ++i) {
            area += graph.areas[chart.faces[piece[i]]];
            for (const uint32_t beyond : neighbours[piece[i]]) {
                if (beyond == no_face) continue;
                if (parts[beyond] != parts[start]) {
                    ++shared[parts[beyond]];
                } else if (!is_seen[beyond]) {
                    is_seen[beyond] = true;
                    piece.push_back(beyond);
                }
            }
        }
        const auto best = std::max_element(shared.begin(), shared.end());
        if (area >= crumb || *best == 0) continue;
        for (const uint32_t t : piece) parts[t] = static_cast<uint32_t>(best - shared.begin());
    }
}

struct Division {
    std::vector<FlatChart> pieces;
    double cost = 0;  ///< room on the map and seams, square metres
};

/// Into `count` parts of about the same length, the cuts moved to where they show least.
Division divide_evenly(const FaceGraph& graph, const FlatChart& chart, uint32_t count,
                       const std::vector<std::array<uint32_t, 3>>& neighbours, const std::vector<double>& along) {
    struct Crossing {  // an edge inside the chart and the stretch of progress over which a cut would open it
        double from;
        double to;
        SeamLength length;
    };
    std::vector<Crossing> crossings;
    for (uint32_t t = 0; t < along.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t beyond = neighbours[t][k];
            if (beyond == no_face || beyond < t || along[t] == along[beyond]) continue;
            Crossing crossing{std::min(along[t], along[beyond]), std::max(along[t], along[beyond]), {}};
            add_edge(graph, chart.faces[t], k, crossing.length);
            crossings.push_back(crossing);
        }
    }
    Division division;
    std::vector<uint32_t> parts(along.size(), 0);
    for (uint32_t cut = 1; cut < count; ++cut) {
        constexpr int tries = 11;  // over the middle fifth of a part
        double best_worth = INFINITY;
        double best_at = 0;
        for (int i = 0; i < tries; ++i) {
            // Beside the places where regular strips have their edges, so that rounding does not choose.
            constexpr double beside = 7.3e-6;
            const double at = (cut + 0.2 * (i - tries / 2) / (tries - 1)) / count + beside;
            SeamLength seam;
            for (const Crossing& c : crossings) {
                if (c.from > at || c.to <= at) continue;
                seam.visible += c.length.visible;
                seam.all += c.length.all;
            }
            // Cuts that show alike: the one nearer to the middle, and of two as near the later one.
            const int off = i - tries / 2;
            const double worth = worth_of(seam, chart.area) * (1 + 0.01 * std::abs(off) - 0.001 * off);
            if (worth < best_worth) best_worth = worth, best_at = at;
        }
        division.cost += best_worth;
        for (uint32_t t = 0; t < along.size(); ++t) parts[t] += along[t] >= best_at ? 1 : 0;
    }
    give_crumbs_away(graph, chart, neighbours, parts);
    division.pieces = divide(graph, chart, parts);
    for (const FlatChart& piece : division.pieces) division.cost += piece.need;
    return division;
}

/// The map as seen from a chart, in metres at the chart's density.
struct Room {
    double need = 0;         ///< of all charts, square metres
    double easy_length = 0;  ///< a chart up to this length fits anywhere
};

double longer_side(const FlatChart& chart) {
    return std::max(chart.extent.x, chart.extent.y);
}

/// What the longest of some charts costs: the density of all falls until it fits.
double cost_of_length(const std::vector<FlatChart>& charts, const Room& room) {
    double longest = room.easy_length;
    for (const FlatChart& chart : charts) longest = std::max(longest, longer_side(chart));
    const double ratio = longest / room.easy_length;
    return room.need * (ratio * ratio - 1);
}

/// The best way to divide a chart; empty when it stays whole.
std::vector<FlatChart> shorten(const FaceGraph& graph, const FlatChart& chart, const Room& room) {
    constexpr double hollow_need = 1.15;  // of the texels of the chart itself
    const bool is_hollow = chart.need > hollow_need * chart.stretch * chart.stretch * chart.area;
    if (chart.is_sliver || chart.faces.size() < 2) return {};
    if (!is_hollow && longer_side(chart) <= room.easy_length) return {};
    const auto neighbours = neighbours_of(chart);
    const std::vector<double> along = progress_along(chart, neighbours, is_hollow);
    Division best{{}, chart.need + cost_of_length({chart}, room)};
    for (uint32_t count = 2; count <= most_parts; ++count) {
        Division division = divide_evenly(graph, chart, count, neighbours, along);
        division.cost += cost_of_length(division.pieces, room);
        if (division.cost < best.cost) best = std::move(division);
    }
    return std::move(best.pieces);
}

}  // namespace

void shorten_charts(const std::vector<FaceGraph>& graphs, const std::vector<double>& factors, double aspect,
                    std::vector<FlatChart>& charts) {
    double need = 0;
    for (size_t i = 0; i < charts.size(); ++i) need += charts[i].need * factors[i] * factors[i];
    const double easy = easy_length * std::sqrt(need / filled_share * aspect);
    std::vector<std::vector<FlatChart>> pieces(charts.size());
    parallel_for(charts.size(), 1, [&](size_t i) {
        const Room room{need / (factors[i] * factors[i]), easy / factors[i]};
        pieces[i] = shorten(graphs[charts[i].surface], charts[i], room);
    });
    std::vector<FlatChart> shorter;
    for (size_t i = 0; i < charts.size(); ++i) {
        if (pieces[i].empty()) pieces[i].push_back(std::move(charts[i]));
        std::move(pieces[i].begin(), pieces[i].end(), std::back_inserter(shorter));
    }
    charts = std::move(shorter);
}

}  // namespace surimi
