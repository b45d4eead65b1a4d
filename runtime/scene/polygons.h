// SPDX-License-Identifier: Apache-2.0
// Triangles -> as few planar convex polygons as their shape allows, of the same area.
#pragma once

#include "runtime/base/math.h"
#include "runtime/light/monitor.h"

#include <array>
#include <optional>
#include <vector>

namespace surimi {

/// Corners counter-clockwise seen from the front.
using Triangle = std::array<Vec3, 3>;

/// The polygons that the triangles make up. Where all of them, or those of one connected flat part, fill one
/// convex polygon, that polygon stands for them (without corners on straight edges); elsewhere every triangle
/// is one. The areas add up to those of the triangles, except that degenerate triangles are left out.
std::vector<Polygon> make_polygons(const std::vector<Triangle>& triangles);

/// The one convex polygon that all triangles fill, whatever their triangulation; none when they are not in
/// one plane, face two sides, leave a hole, overlap or are not convex.
std::optional<Polygon> one_polygon(const std::vector<Triangle>& triangles);

/// Do all triangles lie in one plane and face the same side?
bool is_planar(const std::vector<Triangle>& triangles);

/// Four corners, every angle within 0.6 degrees (1 %) of a right one: what a modelled screen is, and a
/// trapezoid is not.
bool is_rectangle(const Polygon& polygon);

}  // namespace surimi
