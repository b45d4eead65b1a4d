// SPDX-License-Identifier: Apache-2.0
// The visibility map: for every lightmap texel, which share of each monitor's light arrives.
// This file and its .cpp need GLM and runtime/base/*.h alone, so an engine can lift them. map_file, which knows the
// file formats, needs runtime/image too.
#pragma once

#include <array>
#include <string>

#include "runtime/base/image.h"
#include "runtime/base/math.h"

namespace surimi {

struct VisibilityMap {
    Image<Vec3f> visibility;              ///< linear, [0, 1]; unused channels are 1
    std::array<std::string, 3> monitors;  ///< node name of R, G, B; empty where unused
};

/// Bilinear lookup, clamped at the border. uv in [0, 1]^2, v down; NaN reads as 0.
Vec3 look_up(const VisibilityMap& map, const Vec2& uv);

}  // namespace surimi
