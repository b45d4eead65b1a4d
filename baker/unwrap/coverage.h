// SPDX-License-Identifier: Apache-2.0
// Charts on a page of the map, texel by texel: who touches what, who shares it, how far they are apart.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "baker/unwrap/check.h"
#include "runtime/base/image.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

inline constexpr uint32_t no_chart = UINT32_MAX;

/// Triangles of one page, in texels. Those without area there are not among them.
struct PlacedTriangles {
    std::vector<FlatTriangle> texels;
    std::vector<uint32_t> chart;  ///< index into Atlas::charts
    std::vector<TriangleRef> source;
};

/// The triangles of a page on a map of this size, which may be another one than the atlas'.
PlacedTriangles place_triangles(const Atlas& atlas, int page, const glm::ivec2& size);

/// The chart that touches each texel, no_chart where none does; of several, that of the first triangle.
Image<uint32_t> touched_charts(const PlacedTriangles& placed, const glm::ivec2& size);

/// A texel that bilinear reads on two charts touch.
struct SharedTexel {
    int x = 0;
    int y = 0;
    uint32_t first = 0;  ///< triangles of the two charts, numbers within PlacedTriangles
    uint32_t second = 0;
};

/// Calls `visit` for texels in the bilinear footprints of two charts, until it answers false: those are the texels
/// nearer than one to a point of the chart in x and in y, weights up to 1e-3 left aside. A texel can come several
/// times.
void visit_shared_texels(const PlacedTriangles& placed, const glm::ivec2& size,
                         const std::function<bool(const SharedTexel&)>& visit);

/// The chart nearest to each texel (no_chart beyond `reach`), in steps to any of the eight neighbours, and how far.
struct NearestCharts {
    Image<uint32_t> chart;
    Image<uint16_t> distance;
};
NearestCharts nearest_charts(const Image<uint32_t>& touched, int reach);

/// Calls `visit(a, b, distance)` for neighbouring texels that are nearest to different charts a and b; `distance`
/// texels lie between those charts by this way.
void visit_borders(const NearestCharts& nearest, const std::function<void(uint32_t, uint32_t, int)>& visit);

}  // namespace surimi
