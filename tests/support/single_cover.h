// SPDX-License-Identifier: Apache-2.0
// Whether triangles in the plane cover no point twice: exact, and without comparing triangles with each other.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surimi::test {

/// Whole numbers of at most 25 bits.
using GridPoint = std::array<int64_t, 2>;
using GridTriangle = std::array<GridPoint, 3>;

/// Twice the signed area; positive when a, b, c run counter-clockwise with y up.
int64_t doubled_area(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// Empty when the insides of the triangles, all of positive area, are disjoint; otherwise a place where they are not.
///
/// The number of triangles that cover a point is the winding number, about it, of what is left of their edges when
/// those that run both ways cancel. A line swept over the plane (Shamos and Hoey 1976) finds the first crossing of two
/// such edges, which is a double cover, and between its stops checks that the edges that it cuts lead into a triangle
/// and out of one in turn: then every winding number is 0 or 1. That also says that the angles around inner vertices
/// sum to 2 pi and not to a multiple of it, and that no loop lies inside out.
std::string find_double_cover(const std::vector<GridTriangle>& triangles);

}  // namespace surimi::test
