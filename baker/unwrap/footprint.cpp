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

/// Coordinates of a point in a frame whose x is `axis`, of unit length.
Vec2 to_axis(const Vec2& p, const Vec2& axis) {
    return {glm::dot(p, axis), axis.x * p.y - axis.y * p.x};
}

/// Touched texels of a box, row by row.
struct Raster {
    Raster(int w, int h) : width(w), height(h), texels(static_cast<size_t>(w) * static_cast<size_t>(h), 0) {}

    int width;
    int height;
    std::vector<uint8_t> texels;

    uint8_t* row(int y) { return texels.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
    const uint8_t* row(int y) const { return texels.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
};

/// Least and greatest x of the triangle between y = low and y = high; it reaches into that range.
std::array<double, 2> extent_between(const FlatTriangle& t, double low, double high) {
    std::array<double, 2> extent{INFINITY, -INFINITY};
    const auto add = [&](double x) { extent = {std::min(extent[0], x), std::max(extent[1], x)}; };
    for (size_t e = 0; e < 3; ++e) {
        const Vec2& a = t[e];
        const Vec2& b = t[(e + 1) % 3];
        if (a.y >= low && a.y <= high) add(a.x);
        for (const double y : {low, high})
            if ((a.y < y) != (b.y < y)) add(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    return extent;
}

void mark(const FlatTriangle& t, double slack, Raster& raster) {
    const double low = std::min(t[0].y, std::min(t[1].y, t[2].y)) - slack;
    const double high = std::max(t[0].y, std::max(t[1].y, t[2].y)) + slack;
    const int y0 = std::clamp(static_cast<int>(std::floor(low)), 0, raster.height - 1);
    const int y1 = std::clamp(static_cast<int>(std::floor(high)), 0, raster.height - 1);
    for (int y = y0; y <= y1; ++y) {
        const auto [left, right] = extent_between(t, y - slack, y + 1 + slack);
        if (left > right) continue;
        const int x0 = std::clamp(static_cast<int>(std::floor(left - slack)), 0, raster.width - 1);
        const int x1 = std::clamp(static_cast<int>(std::floor(right + slack)), 0, raster.width - 1);
        std::fill(raster.row(y) + x0, raster.row(y) + x1 + 1, uint8_t{1});
    }
}

/// Mirrored at the diagonal: texel (x, y) goes to (y, x).
Raster transposed(const Raster& raster) {
    Raster result(raster.height, raster.width);
    constexpr int block = 32;  // both sides of the copy stay in the cache
    for (int top = 0; top < raster.height; top += block)
        for (int x = 0; x < raster.width; ++x)
            for (int y = top; y < std::min(top + block, raster.height); ++y) result.row(x)[y] = raster.row(y)[x];
    return result;
}

/// One texel for each square of `cell` texels a side.
Raster cells_of(const Raster& raster, int cell) {
    Raster result(raster.width / cell, raster.height / cell);
    for (int y = 0; y < raster.height; ++y)
        for (int x = 0; x < raster.width; ++x) result.row(y / cell)[x / cell] |= raster.row(y)[x];
    return result;
}

Mask to_mask(const Raster& raster) {
    Mask mask;
    mask.width = raster.width;
    mask.height = raster.height;
    for (int y = 0; y < raster.height; ++y) {
        const uint8_t* row = raster.row(y);
        const uint8_t* end = row + raster.width;
        for (const uint8_t* p = std::find(row, end, 1); p != end; p = std::find(p, end, 1)) {
            const uint8_t* stop = std::find(p, end, 0);
            mask.runs.push_back({y, static_cast<int>(p - row), static_cast<int>(stop - p)});
            mask.texels += static_cast<size_t>(stop - p);
            p = stop;
        }
    }
    return mask;
}

/// x to width - x, y to height - y, or both.
Mask flipped(const Mask& mask, bool in_x, bool in_y) {
    Mask result = mask;
    for (Mask::Run& run : result.runs) {
        if (in_x) run.begin = mask.width - run.begin - run.length;
        if (in_y) run.row = mask.height - 1 - run.row;
    }
    // The list is sorted by row, then by x.
    if (in_y) std::reverse(result.runs.begin(), result.runs.end());
    if (in_x == in_y) return result;
    for (auto begin = result.runs.begin(); begin != result.runs.end();) {
        const auto is_beyond = [&](const Mask::Run& run) { return run.row != begin->row; };
        const auto end = std::find_if(begin, result.runs.end(), is_beyond);
        std::reverse(begin, end);
        begin = end;
    }
    return result;
}

Mask to_full_mask(int width, int height) {
    Mask mask{width, height, static_cast<size_t>(width) * static_cast<size_t>(height), {}, 0, 0};
    for (int y = 0; y < height; ++y) mask.runs.push_back({y, 0, width});
    return mask;
}

bool is_same(const Mask& a, const Mask& b) {
    return a.width == b.width && a.height == b.height && a.runs == b.runs;
}

}  // namespace

double coordinate_slack(const MapSize& map) {
    // One step for rounding the chart, one for its corner, eight for repairs (see round_chart).
    return 1e-6 + 10 * uv_step * std::max(map.width, map.height);
}

TexelChart to_texels(const FlatChart& chart, double texels_per_metre, const MapSize& map, const Vec2& axis,
                     int cell) {
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

std::vector<Mask> make_masks(const FlatChart& chart, const TexelChart& shape, const MapSize& map, int cell) {
    const bool is_one = shape.width == cell && shape.height == cell;
    Raster raster = is_one ? Raster(1, 1) : Raster(shape.width, shape.height);
    if (is_one)
        raster.texels[0] = 1;
    else
        for (const auto& t : chart.triangles)
            mark({shape.points[t[0]], shape.points[t[1]], shape.points[t[2]]}, coordinate_slack(map), raster);
    if (!is_one && cell > 1) raster = cells_of(raster, cell);
    const Mask upright = to_mask(raster);
    std::vector<Mask> masks;
    const auto add = [&](Mask mask, int turns) {
        mask.turns = turns;
        const auto is_known = [&](const Mask& other) { return is_same(mask, other); };
        if (std::none_of(masks.begin(), masks.end(), is_known)) masks.push_back(std::move(mask));
    };
    const Mask swapped = upright.texels == raster.texels.size() ? to_full_mask(raster.height, raster.width)
                                                                : to_mask(transposed(raster));
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
