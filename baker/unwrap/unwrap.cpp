// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/unwrap.h"

#include <algorithm>
#include <string>

#include "baker/unwrap/charts.h"
#include "baker/unwrap/density.h"
#include "baker/unwrap/existing.h"
#include "baker/unwrap/fit.h"
#include "baker/unwrap/half_edge.h"
#include "baker/unwrap/round_chart.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// After so many rounds of packing and judging, charts that still fail are cut into single triangles, which
/// cannot fail.
constexpr int patient_rounds = 6;

struct Work {
    std::vector<FaceGraph> graphs;  ///< of each surface
    std::vector<FlatChart> charts;
    std::vector<double> factors;  ///< density of each surface over the atlas'
    std::vector<double> chart_factors;
};

void check_settings(const Scene& scene, const UnwrapSettings& settings) {
    if (triangle_count(scene) == 0) throw Error(ErrorKind::nothing_to_bake, "the scene has no triangle to unwrap");
    if (settings.gutter < 1) throw Error(ErrorKind::usage, "the gutter has to be at least 1 texel");
    constexpr int largest = 16384;
    const bool is_size_fit =
        settings.width >= 1 && settings.height >= 1 && settings.width <= largest && settings.height <= largest;
    if (!(settings.texels_per_metre > 0) && !is_size_fit)
        throw Error(ErrorKind::usage, "the map's size has to be between 1 and 16384 texels, not " +
                                          std::to_string(settings.width) + " x " + std::to_string(settings.height));
}

void cut_scene(const Scene& scene, const Progress& progress, Work& work) {
    work.graphs.resize(scene.surfaces.size());
    std::vector<std::vector<FlatChart>> charts(scene.surfaces.size());
    parallel_stage("charts", scene.surfaces.size(), 1, progress, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            work.graphs[s] = build_face_graph(scene.surfaces[s]);
            charts[s] = cut_into_charts(work.graphs[s]);
            for (FlatChart& chart : charts[s]) chart.surface = static_cast<uint32_t>(s);
        }
    });
    for (auto& some : charts) std::move(some.begin(), some.end(), std::back_inserter(work.charts));
}

/// What becomes of a chart that is not one to one in its final coordinates.
std::vector<FlatChart> take_apart(const FaceGraph& graph, const FlatChart& chart, const RoundedChart& rounded,
                                  int round) {
    std::vector<FlatChart> parts;
    if (round >= patient_rounds) {
        for (const uint32_t f : chart.faces) parts.push_back(flatten(graph, {f}));
    } else if (!rounded.bad.empty()) {
        std::vector<bool> is_bad(chart.faces.size(), false);
        for (const uint32_t t : rounded.bad) is_bad[t] = true;
        std::vector<uint32_t> good;
        for (size_t i = 0; i < chart.faces.size(); ++i) {
            if (is_bad[i])
                parts.push_back(make_sliver(chart.faces[i]));
            else
                good.push_back(chart.faces[i]);
        }
        add_valid_charts(graph, std::move(good), parts);
    } else {
        for (auto& half : split_between(graph, chart.faces, rounded.overlapping[rounded.overlapping.size() / 2]))
            add_valid_charts(graph, std::move(half), parts);
    }
    for (FlatChart& part : parts) part.surface = chart.surface;
    return parts;
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
    for (size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].empty())
            charts.push_back(std::move(work.charts[i]));
        else
            std::move(parts[i].begin(), parts[i].end(), std::back_inserter(charts));
    }
    work.charts = std::move(charts);
    return true;
}

double packing_effort(UvQuality quality) {
    return quality == UvQuality::draft ? 0.2 : quality == UvQuality::medium ? 1 : 5;
}

Layout fit(const Work& work, const UnwrapSettings& settings, const Progress& progress, double known) {
    const FitRequest request{work.charts, work.chart_factors, settings.gutter,
                             progress,    settings.mips,      packing_effort(settings.quality)};
    if (settings.texels_per_metre > 0) return fit_to_density(request, settings.texels_per_metre);
    const MapSize map{settings.width, settings.height};
    return known > 0 ? fit_near(request, map, known) : fit_to_map(request, map);
}

Atlas to_atlas(const Scene& scene, const Work& work, const Layout& layout, const std::vector<RoundedChart>& rounded) {
    Atlas atlas;
    atlas.width = layout.map.width;
    atlas.height = layout.map.height;
    atlas.texels_per_metre = layout.texels_per_metre;
    atlas.surfaces.resize(scene.surfaces.size());
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        atlas.surfaces[s].uv.resize(scene.surfaces[s].triangles.size());
        atlas.surfaces[s].chart.resize(scene.surfaces[s].triangles.size());
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

}  // namespace

Atlas unwrap(const Scene& scene, const UnwrapSettings& settings, const Progress& progress) {
    check_settings(scene, settings);
    if (settings.uv == UvSource::existing) return take_existing(scene, settings);

    Work work;
    std::vector<DensityCap> caps;
    cut_scene(scene, progress, work);
    work.factors = density_factors(scene, caps);
    double known = 0;
    for (int round = 0;; ++round) {
        work.chart_factors.clear();
        for (const FlatChart& chart : work.charts) work.chart_factors.push_back(work.factors[chart.surface]);
        const Layout layout = fit(work, settings, progress, known);
        std::vector<RoundedChart> rounded(work.charts.size());
        parallel_for(work.charts.size(), 16, [&](size_t i) {
            rounded[i] = round_chart(work.charts[i], layout.shapes[i], layout.placements[i], layout.map);
        });
        if (replace_failed(work, rounded, round)) {
            known = layout.texels_per_metre;
            continue;
        }
        Atlas atlas = to_atlas(scene, work, layout, rounded);
        atlas.gutter = settings.gutter;
        atlas.caps = std::move(caps);
        return atlas;
    }
}

}  // namespace surimi
