// SPDX-License-Identifier: Apache-2.0
// Texels that are near each other in the world, on the same side of the surface.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

/// Where a texel is in the world, and its value.
struct TexelPlace {
    Vec3 position{0};        ///< metres
    Vec3 normal{0, 0, 1};    ///< unit; of the triangle, not interpolated: it tells the sides of a surface apart
    double size = 0;         ///< metres along a texel's side; 0 where that means nothing
    uint32_t chart = 0;      ///< index into Atlas::charts
    float visibility = 1.f;  ///< [0, 1]
};

/// Owns a k-d tree over texels that have a value. Calls are thread-safe.
class NearTexels {
  public:
    explicit NearTexels(std::vector<TexelPlace> sources);
    ~NearTexels();
    NearTexels(const NearTexels&) = delete;
    NearTexels& operator=(const NearTexels&) = delete;

    /// The mean of the sources near `place` on its side of its surface, weighed by distance and normal (M62); nothing
    /// where none is within `radius` metres. In between their least and largest value. `place` itself has no say.
    std::optional<float> mean(const TexelPlace& place, double radius) const;

  private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace surimi
