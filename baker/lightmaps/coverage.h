// SPDX-License-Identifier: Apache-2.0
// Which texels of a foreign lightmap lie on a surface, and which of them hang together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baker/lightmaps/lightmap.h"

namespace surimi {

enum class CoverageSource { mask, alpha, light };

struct Coverage {
    CoverageSource source = CoverageSource::light;
    /// By texel: the island that it belongs to, numbered from 0 in the order of their first texels; no_chart outside.
    std::vector<uint32_t> island;
    uint32_t islands = 0;
    size_t texels = 0;  ///< that are covered
};

/// What all charts' brightest light is measured by: the value that one in a thousand of the lightmap's lit texels is
/// above, so that a few fireflies do not count; 0 where there is no light.
double top_of(const Image<float>& light);

/// From the first of these that tells: the mask (not 0), the alpha of the unshadowed lightmaps (above 1/2, unless
/// it is the same everywhere), or light: covered is what any monitor lights unshadowed by more than `threshold` of the
/// lightmap's top. Islands are texels that hang together by their sides, so charts that touch are one. `mask` may be
/// empty; all are of one size.
Coverage find_coverage(std::span<const LightPair> pairs, const Image<uint8_t>& mask, double threshold);

}  // namespace surimi
