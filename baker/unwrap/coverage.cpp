// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/coverage.h"

#include <algorithm>

#include "baker/unwrap/raster.h"

namespace surimi {
namespace {

constexpr uint32_t no_triangle = UINT32_MAX;
constexpr double footprint_reach = 1 - 1e-3;     // a read a thousandth of a texel further has no weight worth a name
constexpr size_t band_texels = size_t{1} << 24;  // 64 MiB of owners at a time

/// Calls `visit(x, y)` for a texel and its up to eight neighbours.
template <class Visit>
void visit_around(const glm::ivec2& middle, const glm::ivec2& size, const Visit& visit) {
    const glm::ivec2 low = glm::max(middle - 1, glm::ivec2(0));
    const glm::ivec2 high = glm::min(middle + 1, size - 1);
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) visit(x, y);
}

/// Texels of some rows and the triangle that came to each first.
class FirstComers {
  public:
    FirstComers(const PlacedTriangles& placed, const TexelRows& rows, std::vector<uint32_t>& storage)
        : placed_(placed), rows_(rows), owners_(storage) {
        owners_.assign(static_cast<size_t>(rows.width) * static_cast<size_t>(rows.end_row - rows.first_row),
                       no_triangle);
    }

    /// Puts in the footprint of a triangle; `visit` hears of texels where another chart was first. False when it
    /// answers false.
    template <class Visit>
    bool add(uint32_t triangle, const Visit& visit) {
        bool goes_on = true;
        visit_runs(placed_.texels[triangle], footprint_reach, rows_, [&](int row, int first, int last) {
            uint32_t* owner =
                owners_.data() + static_cast<size_t>(row - rows_.first_row) * static_cast<size_t>(rows_.width);
            for (int x = first; x <= last && goes_on; ++x) {
                if (owner[x] == no_triangle) owner[x] = triangle;
                if (placed_.chart[owner[x]] != placed_.chart[triangle]) goes_on = visit({x, row, owner[x], triangle});
            }
        });
        return goes_on;
    }

  private:
    const PlacedTriangles& placed_;
    TexelRows rows_;
    std::vector<uint32_t>& owners_;
};

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
    std::vector<uint32_t> storage;
    for (int top = 0; top < size.y; top += band) {
        FirstComers texels(placed, {size.x, top, std::min(top + band, size.y)}, storage);
        for (uint32_t i = 0; i < placed.texels.size(); ++i)
            if (!texels.add(i, visit)) return;
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
        for (const glm::ivec2& from : ring)
            visit_around(from, {touched.width, touched.height}, [&](int x, int y) {
                if (nearest.chart.at(x, y) != no_chart) return;
                nearest.chart.at(x, y) = nearest.chart.at(from.x, from.y);
                nearest.distance.at(x, y) = static_cast<uint16_t>(distance);
                next.push_back({x, y});
            });
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
