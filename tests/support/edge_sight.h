// SPDX-License-Identifier: Apache-2.0
// Silhouettes as (M50) defines them, without a tree: what the tests of baker/gather judge by.
#pragma once

#include <span>
#include <vector>

#include "baker/gather/silhouettes.h"

namespace surimi::test {

/// By how much the number of surfaces before the panel grows across an edge, from det[a - p, b - p, q - p] > 0 to < 0.
int jump_at(const Silhouettes& silhouettes, const Edge& edge, const Vec3& p);

/// Does the segment meet the cone from `p` over a convex polygon, before the polygon's plane? By clipping; `slack`
/// moves all planes out (in where it is negative), in metres at distance 1.
bool is_before(const Vec3& p, std::span<const Vec3> panel, const Vec3& a, const Vec3& b, double slack);

/// How many of the scene's triangles the segment from `p` to `q` pierces; vertices are rounded as find_silhouettes
/// does.
int depth_complexity(const Scene& scene, const Vec3& center, const Vec3& p, const Vec3& q);

}  // namespace surimi::test
