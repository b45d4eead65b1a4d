// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/try_chart.h"

#include "baker/unwrap/curvature.h"
#include "baker/unwrap/relax.h"

namespace surimi {
namespace {

/// How far the forecast may be off before it decides.
constexpr double forecast_tolerance = 2;

/// A single triangle as it is.
Flattening own_frame(const Patch& patch) {
    const auto& t = patch.triangles[0];
    const Vec3 ab = patch.positions[t[1]] - patch.positions[t[0]];
    const Vec3 ac = patch.positions[t[2]] - patch.positions[t[0]];
    const double length = glm::length(ab);
    Flattening flat;
    flat.points.resize(3);
    flat.points[t[1]] = Vec2(length, 0);
    flat.points[t[2]] = Vec2(glm::dot(ab, ac), glm::length(glm::cross(ab, ac))) / length;
    return flat;
}

}  // namespace

std::optional<std::array<uint32_t, 2>> find_overlap(const FlatChart& chart) {
    // As fine as float texture coordinates are on a quarter of the map; contacts of a few such units are left
    // to round_chart, which knows the final coordinates.
    constexpr double units = 1 << 22;
    constexpr double margin = 3;
    constexpr size_t all = 1 << 16;  // but in piles; a few of many would be those that rounding puts first
    const auto pairs = overlapping_pairs(rounded_triangles(chart, units), margin, all);
    if (pairs.empty()) return std::nullopt;
    return pairs[pairs.size() / 2];
}

TriedChart try_chart(const FaceGraph& graph, const Patch& patch, const DistortionBound& bound) {
    TriedChart tried;
    if (patch.triangles.size() == 1) {
        tried.chart = make_chart(graph, patch, own_frame(patch));
        return tried;
    }
    const std::vector<double> logarithms = conformal_logarithms(patch);
    if (predicted_energy(patch, logarithms) - 4 > forecast_tolerance * (bound.energy - 4)) return tried;
    const std::optional<Flattening> flat = flatten_within(patch, logarithms, bound);
    if (!flat) return tried;
    FlatChart chart = make_chart(graph, patch, *flat);
    if (const auto overlap = find_overlap(chart))
        tried.apart = *overlap;
    else
        tried.chart = std::move(chart);
    return tried;
}

}  // namespace surimi
