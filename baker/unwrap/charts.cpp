// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/charts.h"

#include <algorithm>

#include "baker/unwrap/join.h"
#include "baker/unwrap/split.h"
#include "baker/unwrap/try_chart.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

void stop_if_cancelled(const Progress& progress) {
    if (progress.is_cancelled && progress.is_cancelled())
        throw Error(ErrorKind::interrupted, "interrupted while cutting charts");
}

/// Faces meeting at more than this are cut apart: a seam on a crease is not seen. 46 degrees keeps octagonal
/// columns together.
const double crease_cosine = std::cos(46 * pi / 180);

/// A needle's normal is noise of its shape.
bool is_needle(const FaceGraph& graph, uint32_t face) {
    const auto& c = graph.corners[face];
    double longest = 0;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 edge = graph.positions[c[(k + 1) % 3]] - graph.positions[c[k]];
        longest = std::max(longest, glm::dot(edge, edge));
    }
    constexpr double needle_share = 1e-3;
    return graph.areas[face] < needle_share * longest;
}

/// Cuts or joins the creases between some faces.
void set_creases(const FaceGraph& graph, const std::vector<uint32_t>& faces, bool is_cut, SeamFlags& seams) {
    for (const uint32_t f : faces) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t g = graph.neighbours[f][k];
            if (g == no_face || g < f || glm::dot(graph.normals[f], graph.normals[g]) > crease_cosine) continue;
            if (!is_needle(graph, f) && !is_needle(graph, g)) set_seam(graph, f, k, is_cut, seams);
        }
    }
}

/// Splits every part until it is a chart. Parts are independent, so a round of them runs in parallel.
std::vector<FlatChart> split_until_flat(const FaceGraph& graph, std::vector<std::vector<uint32_t>> open,
                                        const CutSettings& settings, const Progress& progress, SeamFlags& seams) {
    std::vector<FlatChart> charts;
    std::vector<uint32_t> number(graph.corners.size());
    bool is_whole = true;  // pieces that creases alone have cut out
    while (!open.empty()) {
        std::vector<TriedChart> attempts(open.size());
        parallel_for(open.size(), 1, [&](size_t i) {
            stop_if_cancelled(progress);
            Patch patch = build_patch(graph, seams, std::move(open[i]), number);
            attempts[i] = try_chart(graph, patch, is_whole ? settings.bound : settings.comfort);
            if (attempts[i].chart) return;
            const bool overlaps = attempts[i].apart[0] != attempts[i].apart[1];
            std::vector<uint8_t> sides =
                overlaps ? split_between(patch.neighbours, centroids(patch), attempts[i].apart) : split_by_shape(patch);
            straighten(graph, patch, sides);
            cut_between(graph, patch, sides, seams);
            attempts[i].parts = connected_parts(graph, seams, patch.faces, number);
        });
        open.clear();
        is_whole = false;
        for (TriedChart& attempt : attempts) {
            if (attempt.chart) charts.push_back(std::move(*attempt.chart));
            std::move(attempt.parts.begin(), attempt.parts.end(), std::back_inserter(open));
        }
    }
    return charts;
}

double area_of(const FaceGraph& graph, const std::vector<uint32_t>& faces) {
    double area = 0;
    for (const uint32_t f : faces) area += graph.areas[f];
    return area;
}

/// Cuts the creases, but not of pieces that lie flat without and would fall into one large part and crumbs: rough
/// ground has creases everywhere, and is one chart all the same.
std::vector<std::vector<uint32_t>> cut_at_creases(const FaceGraph& graph, const std::vector<uint32_t>& faces,
                                                  const CutSettings& settings, SeamFlags& seams,
                                                  std::vector<FlatChart>& charts) {
    std::vector<uint32_t> number(graph.corners.size());
    std::vector<std::vector<uint32_t>> result;
    for (const std::vector<uint32_t>& piece : connected_parts(graph, seams, faces, number)) {
        set_creases(graph, piece, true, seams);
        std::vector<std::vector<uint32_t>> parts = connected_parts(graph, seams, piece, number);
        double largest = 0;
        for (const auto& part : parts) largest = std::max(largest, area_of(graph, part));
        constexpr double dominant_share = 0.6;
        if (parts.size() > 1 && largest > dominant_share * area_of(graph, piece)) {
            set_creases(graph, piece, false, seams);
            TriedChart whole = try_chart(graph, build_patch(graph, seams, piece, number), settings.patience);
            if (whole.chart) {
                charts.push_back(std::move(*whole.chart));
                continue;
            }
            set_creases(graph, piece, true, seams);
        }
        std::move(parts.begin(), parts.end(), std::back_inserter(result));
    }
    return result;
}

}  // namespace

CutSettings cut_settings(const UnwrapSettings& settings, double texels) {
    const double excess = settings.stretch - 1;
    const auto bound = [](double e) { return DistortionBound{4 + energy_of_stretch * e * e, 1 + e}; };
    constexpr double comfort = 0.6;  // of the stretch above 1 that is asked for, by measurement: docs/decisions.md
    constexpr double patience = 1.06;
    return {bound(excess), bound(comfort * excess), bound(patience * excess), settings.quality, texels};
}

std::vector<FlatChart> cut_into_charts(const FaceGraph& graph, const CutSettings& settings, const Progress& progress) {
    std::vector<uint32_t> faces;
    std::vector<FlatChart> slivers;
    for (const uint32_t f : by_rank(graph)) {
        if (graph.is_sliver[f])
            slivers.push_back(make_sliver(f));
        else
            faces.push_back(f);
    }
    SeamFlags seams(graph);
    std::vector<FlatChart> charts;
    std::vector<std::vector<uint32_t>> pieces = cut_at_creases(graph, faces, settings, seams, charts);
    std::vector<FlatChart> flat = split_until_flat(graph, std::move(pieces), settings, progress, seams);
    std::move(flat.begin(), flat.end(), std::back_inserter(charts));
    join_charts(graph, settings, progress, seams, charts);
    std::move(slivers.begin(), slivers.end(), std::back_inserter(charts));
    return charts;
}

}  // namespace surimi
