// SPDX-License-Identifier: Apache-2.0
// Do flat triangles overlap: exactly, and in near-linear time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

using FlatTriangle = std::array<Vec2, 3>;

/// Twice the signed area of a, b, c. Exact when the coordinates are integers of at most 25 bits.
inline double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
inline double doubled_area(const FlatTriangle& t) {
    return doubled_area(t[0], t[1], t[2]);
}

/// Square of the longest edge.
double longest_edge_squared(const FlatTriangle& t);

/// Whether the insides of two counter-clockwise triangles share a point deeper than `margin` behind every
/// edge of either. With margin 0 and integer coordinates of at most 25 bits the answer is exact: touching is
/// not overlapping.
bool do_overlap(const FlatTriangle& a, const FlatTriangle& b, double margin);

/// Area that two triangles of any winding share.
double overlap_area(FlatTriangle a, FlatTriangle b);

/// Calls `visit(i, j)`, i < j, at least once for every two triangles whose boxes overlap; some pairs come
/// several times. Stops when `visit` answers false.
void visit_close_pairs(const std::vector<FlatTriangle>& triangles,
                       const std::function<bool(uint32_t, uint32_t)>& visit);

/// Pairs of triangles that overlap deeper than `margin`, sorted, no pair twice, about `limit` at most.
/// Triangles that are not counter-clockwise are left out. No pair, no flip and every triangle mapped (M43): then
/// the flattening is one to one, whatever holes, slits or branch points the chart has.
std::vector<std::array<uint32_t, 2>> overlapping_pairs(const std::vector<FlatTriangle>& triangles, double margin,
                                                       size_t limit);

}  // namespace surimi
