// SPDX-License-Identifier: Apache-2.0
// A patch -> two parts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/patch.h"

namespace surimi {

/// The side, 0 or 1, of each of some connected triangles, given by their neighbours (number, or no_face) and centroids:
/// each goes to the seed (a number) that is nearer along them.
std::vector<uint8_t> split_between(const std::vector<std::array<uint32_t, 3>>& neighbours,
                                   const std::vector<Vec3>& centroids, const std::array<uint32_t, 2>& seeds);

/// Of the triangles of a patch, in its units.
std::vector<Vec3> centroids(const Patch& patch);

/// Two connected parts that are as flat and compact as they get: two-means over normals and places, grown along the
/// surface (after the variational shape approximation of Cohen-Steiner et al. 2004).
std::vector<uint8_t> split_by_shape(const Patch& patch);

/// Moves the border between two sides to where it shows least, not far from where it is: the minimum cut among the
/// faces near it, in which creases are nearly free.
void straighten(const FaceGraph& graph, const Patch& patch, std::vector<uint8_t>& sides);

/// Cuts the edges between the sides.
void cut_between(const FaceGraph& graph, const Patch& patch, const std::vector<uint8_t>& sides, SeamFlags& seams);

}  // namespace surimi
