// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/coverage.h"

#include <algorithm>

#include "baker/unwrap/raster.h"

namespace surimi {
namespace {

constexpr uint32_t no_triangle = UINT32_MAX;
constexpr double footprint_reach = 1 - 1e-3;     // a read a thousandth of a texel further has no weight worth a name
constexpr size_t band_texels = size_t{1} << 24;  // 64 MiB of owners at a time

}  // namespace

PlacedTriangles place_triangles(const Atlas& atlas, int page, const glm::ivec2& size) {
    PlacedTriangles placed;
    for (uint32_t s = 0; s < atlas.surfaces.size(); ++s) {
        const SurfaceUv& surface = atlas.surfaces[s];
        if (surface.page != page) continue;
        for (uint32_t t = 0; t < surface.uv.size(); ++t) {
            FlatTriangle texels;
            for (size_t k = 0; k < 3; ++k) texels[k] = Vec2(surface.uv[t][k]) * Vec2(size);
            if (doubled_area(texels) == 0) continue;
            placed.texels.push_back(texels);
            placed.chart.push_back(surface.chart[t]);
            placed.source.push_back({s, t});
        }
    }
    return placed;
}

Image<uint32_t> touched_charts(const PlacedTriangles& placed, const glm::ivec2& size) {
    Image<uint32_t> touched(size.x, size.y, no_chart);
    for (size_t i = 0; i < placed.texels.size(); ++i)
        visit_runs(placed.texels[i], 0.5, {size.x, 0, size.y}, [&](int row, int first, int last) {
            uint32_t* texel = &touched.at(first, row);
            for (int x = first; x <= last; ++x, ++texel)
                if (*texel == no_chart) *texel = placed.chart[i];
        });
    return touched;
}

void visit_shared_texels(const PlacedTriangles& placed, const glm::ivec2& size,
                         const std::function<bool(const SharedTexel&)>& visit) {
    const int band = static_cast<int>(std::max<size_t>(1, band_texels / static_cast<size_t>(size.x)));
    Image<uint32_t> owner(size.x, std::min(band, size.y));
    bool goes_on = true;
    for (int top = 0; top < size.y && goes_on; top += band) {
        std::fill(owner.pixels.begin(), owner.pixels.end(), no_triangle);
        const TexelRows rows{size.x, top, std::min(top + band, size.y)};
        for (uint32_t i = 0; i < placed.texels.size() && goes_on; ++i)
            visit_runs(placed.texels[i], footprint_reach, rows, [&](int row, int first, int last) {
                uint32_t* texel = &owner.at(first, row - top);
                for (int x = first; x <= last && goes_on; ++x, ++texel) {
                    if (*texel == no_triangle) *texel = i;
                    if (placed.chart[*texel] != placed.chart[i]) goes_on = visit({x, row, *texel, i});
                }
            });
    }
}

NearestCharts nearest_charts(const Image<uint32_t>& touched, int reach) {
    NearestCharts nearest{touched, Image<uint16_t>(touched.width, touched.height, 0)};
    std::vector<glm::ivec2> ring, next;
    for (int y = 0; y < touched.height; ++y)
        for (int x = 0; x < touched.width; ++x)
            if (touched.at(x, y) != no_chart) ring.push_back({x, y});
    for (int distance = 1; distance <= reach && !ring.empty(); ++distance, ring.swap(next)) {
        next.clear();
        for (const glm::ivec2& from : ring) {
            const uint32_t chart = nearest.chart.at(from.x, from.y);
            for (int y = std::max(0, from.y - 1); y <= std::min(touched.height - 1, from.y + 1); ++y)
                for (int x = std::max(0, from.x - 1); x <= std::min(touched.width - 1, from.x + 1); ++x) {
                    if (nearest.chart.at(x, y) != no_chart) continue;
                    nearest.chart.at(x, y) = chart;
                    nearest.distance.at(x, y) = static_cast<uint16_t>(distance);
                    next.push_back({x, y});
                }
        }
    }
    return nearest;
}

void visit_borders(const NearestCharts& nearest, const std::function<void(uint32_t, uint32_t, int)>& visit) {
    const auto& [charts, distances] = nearest;
    const auto compare = [&](size_t a, size_t b) {
        const uint32_t one = charts.pixels[a];
        const uint32_t other = charts.pixels[b];
        if (one != other && one != no_chart && other != no_chart)
            visit(one, other, distances.pixels[a] + distances.pixels[b]);
    };
    for (int y = 0; y < charts.height; ++y)
        for (int x = 0; x < charts.width; ++x) {
            const size_t here = charts.index(x, y);
            if (x + 1 < charts.width) compare(here, here + 1);
            if (y + 1 == charts.height) continue;
            for (int beside = std::max(0, x - 1); beside <= std::min(charts.width - 1, x + 1); ++beside)
                compare(here, charts.index(beside, y + 1));
        }
}

}  // namespace surimi
