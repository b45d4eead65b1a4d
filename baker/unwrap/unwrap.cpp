// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/unwrap.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "baker/unwrap/charts.h"
#include "baker/unwrap/density.h"
#include "baker/unwrap/existing.h"
#include "baker/unwrap/fit_pages.h"
#include "baker/unwrap/half_edge.h"
#include "baker/unwrap/round_chart.h"
#include "baker/unwrap/shorten.h"
#include "baker/unwrap/split.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// After so many rounds of packing and judging, charts that still fail are cut into single triangles, which
/// cannot fail.
constexpr int patient_rounds = 6;

struct Work {
    std::vector<FaceGraph> graphs;  ///< of each surface
    std::vector<FlatChart> charts;
    std::vector<ChartWeight> weights;  ///< of each chart
    Pages pages;
};

void check_settings(const Scene& scene, const UnwrapSettings& settings) {
    if (triangle_count(scene) == 0) throw Error(ErrorKind::nothing_to_bake, "the scene has no triangle to unwrap");
    if (std::ranges::none_of(scene.surfaces, [](const Surface& surface) { return surface.receives; }))
        throw Error(ErrorKind::nothing_to_bake,
                    "every surface of the scene is excluded or does not receive, so nothing is left to bake; take one "
                    "back with exclude = false or receives = true in its node's extras or an [[object]] of the "
                    "settings file");
    if (settings.gutter < 1) throw Error(ErrorKind::usage, "the gutter has to be at least 1 texel");
    if (!(settings.stretch > 1)) throw Error(ErrorKind::usage, "the stretch allowed has to be above 1");
    if (settings.atlases < 1 || settings.atlases > 64)
        throw Error(ErrorKind::usage,
                    "a scene goes on 1 to 64 atlases, not " + std::to_string(settings.atlases) + "; raise the size");
    if (settings.atlases > 1 && settings.uv == UvSource::existing)
        throw Error(ErrorKind::usage, "existing UVs are those of one map; leave out --atlases, or use --uv unwrap");
    constexpr int largest = 16384;
    const bool is_size_fit =
        settings.width >= 1 && settings.height >= 1 && settings.width <= largest && settings.height <= largest;
    if (!(settings.texels_per_metre > 0) && !is_size_fit)
        throw Error(ErrorKind::usage, "the map's size has to be between 1 and 16384 texels, not " +
                                          std::to_string(settings.width) + " x " + std::to_string(settings.height));
}

/// About how many texels each surface will have.
std::vector<double> expected_texels(const std::vector<FaceGraph>& graphs, const UnwrapSettings& settings) {
    std::vector<double> areas;
    double whole = 0;
    for (const FaceGraph& graph : graphs) {
        areas.push_back(std::accumulate(graph.areas.begin(), graph.areas.end(), 0.0));
        whole += areas.back();
    }
    const double map = static_cast<double>(settings.width) * settings.height * settings.atlases;
    const double density =
        settings.texels_per_metre > 0 ? settings.texels_per_metre : std::sqrt(whole > 0 ? map / whole : 0);
    for (double& area : areas) area *= density * density;  // texels now
    return areas;
}

void cut_scene(const Scene& scene, const UnwrapSettings& settings, const Progress& progress, Work& work) {
    work.graphs.resize(scene.surfaces.size());
    std::vector<std::vector<FlatChart>> charts(scene.surfaces.size());
    parallel_for(scene.surfaces.size(), 1, [&](size_t s) {
        if (scene.surfaces[s].receives) work.graphs[s] = build_face_graph(scene.surfaces[s]);
    });
    const std::vector<double> texels = expected_texels(work.graphs, settings);
    parallel_stage("charts", scene.surfaces.size(), 1, progress, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            if (!scene.surfaces[s].receives) continue;
            charts[s] = cut_into_charts(work.graphs[s], cut_settings(settings, texels[s]), progress);
            for (FlatChart& chart : charts[s]) chart.surface = static_cast<uint32_t>(s);
        }
    });
    for (auto& some : charts) std::move(some.begin(), some.end(), std::back_inserter(work.charts));
}

/// What becomes of a chart that is not one to one in its final coordinates.
std::vector<FlatChart> take_apart(const FaceGraph& graph, const FlatChart& chart, const RoundedChart& rounded,
                                  int round) {
    std::vector<uint32_t> parts(chart.faces.size(), 0);
    std::vector<FlatChart> slivers;
    if (round >= patient_rounds) {
        std::iota(parts.begin(), parts.end(), 0u);
    } else if (!rounded.bad.empty()) {
        for (const uint32_t t : rounded.bad) {
            parts[t] = left_out;
            slivers.push_back(make_sliver(chart.faces[t]));
            slivers.back().surface = chart.surface;
        }
    } else {
        const auto& apart = rounded.overlapping[rounded.overlapping.size() / 2];
        const std::vector<uint8_t> sides = split_between(neighbours_of(chart), centroids_of(chart), apart);
        parts.assign(sides.begin(), sides.end());
    }
    std::vector<FlatChart> pieces = divide(graph, chart, parts);
    std::move(slivers.begin(), slivers.end(), std::back_inserter(pieces));
    return pieces;
}

bool is_one_to_one(const RoundedChart& rounded) {
    return rounded.bad.empty() && rounded.overlapping.empty();
}

/// Replaces the charts that failed; false when none did.
bool replace_failed(Work& work, const std::vector<RoundedChart>& rounded, int round) {
    std::vector<std::vector<FlatChart>> parts(work.charts.size());
    parallel_for(work.charts.size(), 16, [&](size_t i) {
        const FlatChart& chart = work.charts[i];
        if (!is_one_to_one(rounded[i])) parts[i] = take_apart(work.graphs[chart.surface], chart, rounded[i], round);
    });
    if (std::all_of(rounded.begin(), rounded.end(), is_one_to_one)) return false;
    std::vector<FlatChart> charts;
    std::vector<ChartWeight> weights;
    for (size_t i = 0; i < parts.size(); ++i) {
        weights.insert(weights.end(), std::max<size_t>(1, parts[i].size()), work.weights[i]);
        if (parts[i].empty())
            charts.push_back(std::move(work.charts[i]));
        else
            std::move(parts[i].begin(), parts[i].end(), std::back_inserter(charts));
    }
    work.charts = std::move(charts);
    work.weights = std::move(weights);
    return true;
}

std::vector<double> factors_of(const std::vector<ChartWeight>& weights) {
    std::vector<double> factors;
    factors.reserve(weights.size());
    for (const ChartWeight& weight : weights) factors.push_back(density_factor(weight));
    return factors;
}

double packing_effort(UvQuality quality) {
    return quality == UvQuality::draft ? 0.2 : quality == UvQuality::medium ? 1 : 5;
}

Atlas to_atlas(const Scene& scene, const Work& work, const Layout& layout, const std::vector<RoundedChart>& rounded) {
    Atlas atlas;
    atlas.width = layout.map.width;
    atlas.height = layout.map.height;
    atlas.pages = static_cast<int>(work.pages.densities.size());
    atlas.texels_per_metre = layout.texels_per_metre;
    atlas.surfaces.resize(scene.surfaces.size());
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        if (!scene.surfaces[s].receives) continue;
        atlas.surfaces[s].uv.resize(scene.surfaces[s].triangles.size());
        atlas.surfaces[s].chart.resize(scene.surfaces[s].triangles.size());
        atlas.surfaces[s].page = work.pages.of_surface[s];
    }
    for (uint32_t i = 0; i < work.charts.size(); ++i) {
        const FlatChart& chart = work.charts[i];
        SurfaceUv& surface = atlas.surfaces[chart.surface];
        for (size_t f = 0; f < chart.faces.size(); ++f) {
            const std::array<uint32_t, 3> t = chart.is_sliver ? std::array<uint32_t, 3>{0, 1, 2} : chart.triangles[f];
            for (size_t k = 0; k < 3; ++k)
                surface.uv[chart.faces[f]][k] = Vec2f(rounded[i].points[t[k]] * uv_step);  // exact
            surface.chart[chart.faces[f]] = i;
        }
        atlas.charts.push_back({chart.surface, layout.shapes[i].texels_per_metre});
    }
    return atlas;
}

std::vector<ChartWeight> weigh(const Scene& scene, const UnwrapSettings& settings, const std::vector<FlatChart>& charts,
                               const std::vector<double>& scales) {
    return settings.is_uniform ? wished_weights(charts, scales) : weigh_charts(scene, charts, scales);
}

double aspect_of(const UnwrapSettings& settings) {
    if (settings.texels_per_metre > 0) return 1;  // the size that follows is square
    return static_cast<double>(std::max(settings.width, settings.height)) / std::min(settings.width, settings.height);
}

}  // namespace

Atlas unwrap(const Scene& scene, const UnwrapSettings& settings, const Progress& progress) {
    check_settings(scene, settings);
    std::string why_new_charts;
    if (auto existing = take_existing(scene, settings, why_new_charts)) return *existing;

    const std::vector<double> scales = texel_scales(scene, settings.texel_scales);
    Work work;
    cut_scene(scene, settings, progress, work);
    work.weights = weigh(scene, settings, work.charts, scales);
    shorten_charts(work.graphs, factors_of(work.weights), aspect_of(settings), work.charts);
    work.weights = weigh(scene, settings, work.charts, scales);
    for (int round = 0;; ++round) {
        const std::vector<double> factors = factors_of(work.weights);
        const FitRequest request{work.charts, factors,       settings.gutter,
                                 progress,    settings.mips, packing_effort(settings.quality)};
        const Layout layout = fit_pages(scene, request, settings, work.pages);
        std::vector<RoundedChart> rounded(work.charts.size());
        parallel_for(work.charts.size(), 16, [&](size_t i) {
            rounded[i] = round_chart(work.charts[i], layout.shapes[i], layout.placements[i], layout.map);
        });
        if (replace_failed(work, rounded, round)) continue;
        Atlas atlas = to_atlas(scene, work, layout, rounded);
        atlas.gutter = settings.gutter;
        mark_full_pages(work.charts, work.pages, layout.texels_per_metre, work.weights);
        atlas.weights = list_weights(work.charts, work.weights);
        atlas.uv_reason = why_new_charts;
        for (const FaceGraph& graph : work.graphs) atlas.meshes.add(graph.counts);
        return atlas;
    }
}

}  // namespace surimi
