// SPDX-License-Identifier: Apache-2.0
// Convex polygons in the plane.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

/// The part of a convex polygon where x * line.x + y * line.y + line.z >= 0, into `part` (Sutherland and Hodgman 1974);
/// empty where no more than a segment is left.
void cut(std::span<const Vec2> polygon, const Vec3& line, std::vector<Vec2>& part);

/// Area of a polygon, positive counter-clockwise.
double area_of(std::span<const Vec2> polygon);

}  // namespace surimi
