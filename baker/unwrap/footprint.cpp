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

using Texels = std::vector<uint8_t>;

/// Whether triangle `t` meets the open square around `centre` with half side `half`: no side of either
/// separates them.
bool meets_square(const FlatTriangle& t, const Vec2& centre, double half) {
    const Vec2 low = glm::min(t[0], glm::min(t[1], t[2])) - centre;
    const Vec2 high = glm::max(t[0], glm::max(t[1], t[2])) - centre;
    if (low.x >= half || low.y >= half || high.x <= -half || high.y <= -half) return false;
    for (size_t e = 0; e < 3; ++e) {
        const Vec2 edge = t[(e + 1) % 3] - t[e];
        const Vec2 normal(-edge.y, edge.x);  // inwards: all of the triangle lies on its positive side
        const double reach = half * (std::abs(normal.x) + std::abs(normal.y));
        if (glm::dot(normal, t[e] - centre) >= reach) return false;
    }
    return true;
}

void mark(const FlatTriangle& t, double slack, const TexelChart& shape, Texels& texels) {
    const Vec2 low = glm::min(t[0], glm::min(t[1], t[2])) - slack;
    const Vec2 high = glm::max(t[0], glm::max(t[1], t[2])) + slack;
    const int x0 = std::clamp(static_cast<int>(std::floor(low.x)), 0, shape.width - 1);
    const int x1 = std::clamp(static_cast<int>(std::floor(high.x)), 0, shape.width - 1);
    const int y0 = std::clamp(static_cast<int>(std::floor(low.y)), 0, shape.height - 1);
    const int y1 = std::clamp(static_cast<int>(std::floor(high.y)), 0, shape.height - 1);
    for (int y = y0; y <= y1; ++y) {
        uint8_t* row = texels.data() + static_cast<size_t>(y) * static_cast<size_t>(shape.width);
        for (int x = x0; x <= x1; ++x)
            if (row[x] == 0 && meets_square(t, Vec2(x + 0.5, y + 0.5), 0.5 + slack)) row[x] = 1;
    }
}

Texels turn_texels(const Texels& texels, int width, int height) {
    Texels result(texels.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result[static_cast<size_t>(x) * static_cast<size_t>(height) + static_cast<size_t>(height - 1 - y)] =
                texels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    return result;
}

Mask to_runs(const Texels& texels, int width, int height) {
    Mask mask;
    mask.width = width;
    mask.height = height;
    for (int y = 0; y < height; ++y) {
        const uint8_t* row = texels.data() + static_cast<size_t>(y) * static_cast<size_t>(width);
        for (int x = 0; x < width;) {
            if (row[x] == 0) {
                ++x;
                continue;
            }
            const int begin = x;
            while (x < width && row[x] != 0) ++x;
            mask.runs.push_back({y, begin, x - begin});
            mask.texels += static_cast<size_t>(x - begin);
        }
    }
    return mask;
}

}  // namespace

double coordinate_slack(const MapSize& map) {
    // One step for rounding the chart, one for its corner, eight for repairs (see round_chart).
    return 1e-6 + 10 * uv_step * std::max(map.width, map.height);
}

TexelChart to_texels(const FlatChart& chart, double texels_per_metre, const MapSize& map) {
    TexelChart shape;
    if (chart.is_sliver) {
        shape.points = {Vec2(sliver_low), Vec2(sliver_high, sliver_low), Vec2(sliver_low, sliver_high)};
        return shape;
    }
    const double slack = coordinate_slack(map);
    // Area-true: projection shrinks what leans, the scale gives it back.
    double scale = texels_per_metre * std::sqrt(chart.area / chart.flat_area);
    // 64 steps of the float grid for each of the square root of the triangles keep a typical triangle well
    // formed.
    const double fine =
        64 * uv_step * std::max(map.width, map.height) * std::sqrt(static_cast<double>(chart.faces.size()));
    const double least = std::max(least_extent, fine);
    const double longer = std::max(chart.extent.x, chart.extent.y);
    scale = std::max(scale, least / longer);
    shape.texels_per_metre = scale / std::sqrt(chart.area / chart.flat_area);
    const auto widen = [&](double extent) { return std::max(scale, 0.5 * least / extent); };
    const Vec2 scales(widen(chart.extent.x), widen(chart.extent.y));
    const Vec2 extent = scales * chart.extent;
    shape.width = std::max(1, static_cast<int>(std::ceil(extent.x + 2 * slack)));
    shape.height = std::max(1, static_cast<int>(std::ceil(extent.y + 2 * slack)));
    const Vec2 centring = 0.5 * (Vec2(shape.width, shape.height) - extent);
    shape.points.reserve(chart.points.size());
    for (const Vec2& p : chart.points) shape.points.push_back(p * scales + centring);
    return shape;
}

Vec2 turned(const Vec2& p, const TexelChart& chart, int turns) {
    switch (turns & 3) {
        case 1:
            return {chart.height - p.y, p.x};
        case 2:
            return {chart.width - p.x, chart.height - p.y};
        case 3:
            return {p.y, chart.width - p.x};
        default:
            return p;
    }
}

std::vector<Mask> make_masks(const FlatChart& chart, const TexelChart& shape, const MapSize& map) {
    int width = shape.width;
    int height = shape.height;
    Texels texels(static_cast<size_t>(width) * static_cast<size_t>(height), width == 1 && height == 1 ? 1 : 0);
    const double slack = coordinate_slack(map);
    if (width > 1 || height > 1) {
        for (const auto& t : chart.triangles)
            mark({shape.points[t[0]], shape.points[t[1]], shape.points[t[2]]}, slack, shape, texels);
    }
    std::vector<Mask> masks{to_runs(texels, width, height)};
    const bool is_full = masks[0].texels == texels.size();
    const int turns = is_full ? (width == height ? 1 : 2) : 4;
    for (int i = 1; i < turns; ++i) {
        texels = turn_texels(texels, width, height);
        std::swap(width, height);
        masks.push_back(to_runs(texels, width, height));
    }
    return masks;
}

}  // namespace surimi
