// SPDX-License-Identifier: Apache-2.0
// Monitors as geometry: the triangles of surfaces, and the rectangles that nodes without a mesh describe.
#pragma once

#include "runtime/scene/polygons.h"
#include "runtime/scene/scene.h"

#include <vector>

namespace surimi {

std::vector<Triangle> triangles_of(const Scene& scene, const std::vector<size_t>& surfaces);

/// The rectangle of half extents u, v around `center`; its front is the side that `front` looks to.
Polygon make_rectangle(const Vec3& center, const Vec3& half_u, const Vec3& half_v, const Vec3& front);

/// extras.monitor_size: width and height along the node's x and y, scaled with it, facing its +z.
Polygon sized_rectangle(const Node& node);

/// EXT_lights_area: faces -z; of the node's scale only the largest component counts, for both sides.
Polygon light_rectangle(const Node& node);

/// Are the corners the same within 1 % of the size? A light and the quad that shows it are modelled to
/// coincide; exporters and hands are off by less.
bool do_coincide(const Polygon& a, const Polygon& b);

}  // namespace surimi
