// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/footprint.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

/// Charts get at least this many texels across in one direction, and half of it in the other.
constexpr double least_extent = 0.5;
/// A sliver's token: a triangle that fits one texel with some air.
constexpr double sliver_low = 0.2;
constexpr double sliver_high = 0.8;

bool is_same(const Mask& a, const Mask& b) {
    return a.width == b.width && a.height == b.height && a.runs == b.runs;
}

}  // namespace

double coordinate_slack(const MapSize& map) {
    // One step for rounding the chart, one for its corner, eight for repairs (see round_chart).
    return 1e-6 + 10 * uv_step * std::max(map.width, map.height);
}

TexelChart to_texels(const FlatChart& chart, double texels_per_metre, const MapSize& map, const Vec2& axis, int cell) {
    TexelChart shape;
    if (chart.is_sliver) {
        shape.width = shape.height = cell;
        shape.points = {Vec2(sliver_low), Vec2(sliver_high, sliver_low), Vec2(sliver_low, sliver_high)};
        return shape;
    }
    Vec2 low{INFINITY};
    Vec2 high{-INFINITY};
    shape.points.reserve(chart.points.size());
    for (const Vec2& p : chart.points) {
        shape.points.push_back(to_axis(p, axis));
        low = glm::min(low, shape.points.back());
        high = glm::max(high, shape.points.back());
    }
    const Vec2 size = high - low;
    const double slack = coordinate_slack(map);
    // Area-true: projection shrinks what leans, the scale gives it back.
    double scale = texels_per_metre * std::sqrt(chart.area / chart.flat_area);
    // 64 steps of the float grid for each of the square root of the triangles keep a typical triangle well
    // formed.
    const double fine =
        64 * uv_step * std::max(map.width, map.height) * std::sqrt(static_cast<double>(chart.faces.size()));
    const double least = std::max(least_extent, fine);
    scale = std::max(scale, least / std::max(size.x, size.y));
    shape.texels_per_metre = scale / std::sqrt(chart.area / chart.flat_area);
    const auto widen = [&](double extent) { return std::max(scale, 0.5 * least / extent); };
    const Vec2 scales(widen(size.x), widen(size.y));
    const Vec2 extent = scales * size;
    const auto whole_cells = [&](double length) {
        return cell * std::max(1, static_cast<int>(std::ceil((length + 2 * slack) / cell)));
    };
    shape.width = whole_cells(extent.x);
    shape.height = whole_cells(extent.y);
    const Vec2 centring = 0.5 * (Vec2(shape.width, shape.height) - extent);
    for (Vec2& p : shape.points) p = (p - low) * scales + centring;
    return shape;
}

Vec2 turned(const Vec2& p, const TexelChart& chart, int turns) {
    const Vec2 q = turns >= mirrored ? Vec2(chart.width - p.x, p.y) : p;
    switch (turns & 3) {
        case 1:
            return {chart.height - q.y, q.x};
        case 2:
            return {chart.width - q.x, chart.height - q.y};
        case 3:
            return {q.y, chart.width - q.x};
        default:
            return q;
    }
}

Outline chart_outline(const FlatChart& chart) {
    std::vector<std::array<uint32_t, 2>> edges;
    for (const auto& t : chart.triangles)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k];
            const uint32_t b = t[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(edges.begin(), edges.end());
    Outline outline;
    for (auto begin = edges.begin(); begin != edges.end();) {
        const auto end = std::find_if(begin, edges.end(), [&](const auto& edge) { return edge != *begin; });
        if ((end - begin) % 2 != 0) outline.push_back(*begin);
        begin = end;
    }
    return outline.empty() ? edges : outline;
}

std::vector<Mask> make_masks(const Outline& outline, const TexelChart& shape, const MapSize& map, int cell) {
    const auto mask_of = [&](bool is_swapped) {
        const auto place = [&](const Vec2& p) { return is_swapped ? Vec2(p.y, p.x) : p; };
        Raster raster(is_swapped ? shape.height : shape.width, is_swapped ? shape.width : shape.height);
        for (const auto& [a, b] : outline)
            raster.add_edge(place(shape.points[a]), place(shape.points[b]), coordinate_slack(map));
        raster.fill();
        return cell == 1 ? raster.mask() : raster.cells(cell).mask();
    };
    if (shape.width == cell && shape.height == cell) {
        Raster raster(1, 1);
        raster.add_edge(Vec2(0.5), Vec2(0.5), 0);
        return {raster.mask()};
    }
    const Mask upright = mask_of(false);
    const Mask swapped = mask_of(true);
    std::vector<Mask> masks;
    const auto add = [&](Mask mask, int turns) {
        mask.turns = turns;
        const auto is_known = [&](const Mask& other) { return is_same(mask, other); };
        if (std::none_of(masks.begin(), masks.end(), is_known)) masks.push_back(std::move(mask));
    };
    // A turn is a swap of x and y and a flip; rotations come first, so that of equal masks one stays unmirrored.
    add(upright, 0);
    add(flipped(swapped, true, false), 1);
    add(flipped(upright, true, true), 2);
    add(flipped(swapped, false, true), 3);
    add(flipped(upright, true, false), mirrored);
    add(flipped(swapped, true, true), mirrored + 1);
    add(flipped(upright, false, true), mirrored + 2);
    add(swapped, mirrored + 3);
    return masks;
}

}  // namespace surimi
