// SPDX-License-Identifier: Apache-2.0
// Distances along triangles, from centroid to centroid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

struct Walk {
    std::vector<float> distance;   ///< of each triangle from the nearest source; infinite where none is reached
    std::vector<uint32_t> source;  ///< that source's position in `sources`
    uint32_t last = 0;             ///< the farthest triangle
};

/// The shortest ways from some triangles to all others (Dijkstra 1959). `neighbours`: number beyond each edge, or
/// no_face. Floats, so that ways that are equal but for rounding are equal; then the lower number comes first.
Walk walk_from(const std::vector<uint32_t>& sources, const std::vector<std::array<uint32_t, 3>>& neighbours,
               const std::vector<Vec3>& centroids);

}  // namespace surimi
