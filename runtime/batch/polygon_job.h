// SPDX-License-Identifier: Apache-2.0
// One polygon light prepared for the kernels of every instruction set, and how they are given their points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/batch/batch.h"

namespace surimi {

struct PolygonJob {
    std::vector<Vec3> corners;  ///< times `scale`
    std::vector<Vec3> edges;    ///< times `scale`; the i-th one ends at the i-th corner
    double scale = 1;           ///< a power of two; the light's extent times it is between 1 and 2
    double far2 = 0;            ///< squared distance, times scale^2, from which on the light counts as tiny
    bool is_two_sided = false;
    bool has_diffuse = true, has_specular = true;
    std::span<const uint8_t> is_wanted;  ///< empty: all
};

/// What the kernels read of a point and its lobe; the order of BlockInput::field.
enum class Field {
    position_x,
    position_y,
    position_z,
    normal_x,
    normal_y,
    normal_z,
    tangent_x,
    tangent_y,
    tangent_z,
    xx,
    xz,
    zx,
    zz,
    share_above,
    albedo,
    count
};

/// Where each field of a block's points lies, one number after the other; null for a lobe that is not there.
struct BlockInput {
    std::array<const double*, static_cast<size_t>(Field::count)> field;
};

}  // namespace surimi
