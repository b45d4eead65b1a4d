// SPDX-License-Identifier: Apache-2.0
// First ways to lay a patch flat, to be relaxed from there.
#pragma once

#include <vector>

#include "baker/unwrap/laplacian.h"
#include "baker/unwrap/patch.h"

namespace surimi {

enum class Start {
    projection,  ///< along the mean normal: next to nothing to compute, for patches that are height fields
    conformal,   ///< lengths kept along the boundary, angles everywhere (M44): exact for developable patches
    tutte,       ///< boundary on a circle (Tutte 1963): without flips for every disk, whatever its shape
};

/// Points of the patch's vertices without flipped triangles and with the patch's area; false when the way gives none.
/// `logarithms` are those of conformal_logarithms.
bool make_start(const Patch& patch, Start start, const std::vector<double>& logarithms, Laplacian& laplacian,
                std::vector<Vec2>& points);

}  // namespace surimi
