// SPDX-License-Identifier: Apache-2.0
// Light of subtexels -> light of texels.
#pragma once

#include <span>
#include <vector>

#include "baker/gather/exposure.h"
#include "baker/gather/gather.h"

namespace surimi {

/// The average over subtexels with these areas of surface, m^2: shadowed and unshadowed, never their ratio (M64). Areas
/// count as equal where all are 0. The error is that of independent errors, the method the strongest. Zeros of nothing.
IrradianceEstimate average(std::span<const IrradianceEstimate> subtexels, std::span<const double> areas);

/// One estimate for each of `texels` from those of their subtexels, which are subdivided() and the receivers' texels.
/// Weights are what is free of the subtexels (exposed_area).
std::vector<IrradianceEstimate> downsample(const Receivers& receivers, const Texels& texels,
                                           std::span<const IrradianceEstimate> estimates);

}  // namespace surimi
