// SPDX-License-Identifier: Apache-2.0
// What flattening a patch will cost, from its Gauss curvature alone.
#pragma once

#include <vector>

#include "baker/unwrap/patch.h"

namespace surimi {

/// The logarithm of the scale, at each vertex, of the conformal map to the plane that keeps the lengths of the
/// boundary: 0 there, the solution of Poisson's equation with the Gauss curvature inside (M44). Of all conformal maps
/// it has the smallest range of scales. Empty for closed patches, and where rounding spoils the system.
std::vector<double> conformal_logarithms(const Patch& patch);

/// About the least mean symmetric Dirichlet energy of the patch in the plane (M44), for a fraction of the time that it
/// takes to find it; infinite when there are no logarithms.
double predicted_energy(const Patch& patch, const std::vector<double>& logarithms);

}  // namespace surimi
