// SPDX-License-Identifier: Apache-2.0
// The borders of charts in the world: triangles' edges beyond which the map does not go on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// One triangle's edge, counter-clockwise seen from the triangle's front: the triangle lies to the left of it.
struct BorderEdge {
    std::array<Vec3, 2> ends;     ///< metres
    std::array<Vec3, 2> normals;  ///< unit shading normals at the ends
    std::array<Vec2, 2> texels;   ///< where the ends are on the page
    Vec3f face{0};                ///< unit, geometric normal
    uint32_t chart = 0;
    int page = 0;
    double length = 0;     ///< metres
    double tolerance = 0;  ///< metres by which its place is uncertain, as far as its triangle can bear it (M60)

    Vec3 direction() const { return (ends[1] - ends[0]) / length; }
};

/// All of an atlas' charts, in the order of surfaces, triangles and corners; of surfaces that have uv. Those of charts
/// without a density (slivers) and those that are a point on the map are left out: they are no place to compare.
/// n log n, parallel.
std::vector<BorderEdge> find_border_edges(const Scene& scene, const Atlas& atlas);

}  // namespace surimi
