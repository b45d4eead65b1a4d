// SPDX-License-Identifier: Apache-2.0
// A patch laid flat with as little distortion as it gets.
#pragma once

#include <optional>
#include <vector>

#include "baker/unwrap/distortion.h"
#include "baker/unwrap/laplacian.h"

namespace surimi {

struct Flattening {
    std::vector<Vec2> points;  ///< of the patch's vertices, no triangle flipped
    Distortion distortion;
};

/// The patch in the plane, close to the least symmetric Dirichlet energy (M42), when that is within the bound; nothing
/// when it is not, as soon as that is clear, or when no start without flips is found. The boundary may cross itself.
/// `logarithms` are those of conformal_logarithms.
std::optional<Flattening> flatten_within(const Patch& patch, const std::vector<double>& logarithms,
                                         const DistortionBound& bound);

/// Lowers the energy of points without flips by steps of scalable locally injective mappings (Rabinovich et al. 2017)
/// with the flip-preventing line search of Smith and Schaefer 2015, until it hardly falls, or clearly stays above
/// `bound`. The steps are found by conjugate gradients, preconditioned with the Laplacian.
void relax(const Patch& patch, double bound, Laplacian& laplacian, std::vector<Vec2>& points);

}  // namespace surimi
