// SPDX-License-Identifier: Apache-2.0
// A channel of a visibility map from two lightmaps of another baker.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "baker/lightmaps/coverage.h"
#include "baker/lightmaps/lightmap.h"
#include "baker/post/channel.h"

namespace surimi {

struct LightmapRatioSettings {
    double threshold = 1e-4;  ///< [0, 1): unshadowed light below this share of its top is residue
    double noise = 0.1;       ///< above 0: the largest standard deviation of unshadowed light, as a share of it
};

/// What was wrong in two lightmaps. Numbers of covered texels, unless they say otherwise.
struct LightmapFaults {
    size_t not_finite = 0;         ///< NaN or infinite in either
    size_t negative = 0;           ///< below 0 in either
    size_t without_light = 0;      ///< unshadowed light is 0: behind the monitor, or unknown
    size_t shadow_of_nothing = 0;  ///< of these, shadowed light is above 0
    size_t residue = 0;            ///< unshadowed light is above 0, but below the threshold
    size_t noisy = 0;              ///< above it, but noisier than allowed
    size_t above_one = 0;          ///< used, though shadowed light is more than 1.05 times unshadowed light
    size_t measured = 0;           ///< used
    double largest_ratio = 0;      ///< of those used, before clamping
    double least_light = 0;        ///< the threshold in the lightmap's unit
    uint32_t dark_islands = 0;     ///< islands of which no texel could be used: they are 1, nothing known to block
};

struct RatioOfLightmaps {
    Channel channel;  ///< covered: measured; unlit: on a surface, filled; filled: gutter
    LightmapFaults faults;
};

/// V = clamp(shadowed / unshadowed, 0, 1) where unshadowed light can be told from residue and noise (M68). Other
/// covered texels take values through their own island, then everything outside from the islands around it, all in
/// double-buffered rings. Values are clamped before anything is averaged. Throws Error(nothing_to_bake) where no texel
/// can be used.
RatioOfLightmaps ratio_of(const LightPair& pair, const Coverage& coverage, const LightmapRatioSettings& settings);

/// What Kanikama's pack shader writes for the same: L(n) / max(1e-4, L(d)), 0 where L(d) is 0; neither clamped nor
/// filled (KanikamaRatioPack.shader, lines 59 to 73). `light` of both has to be weighted by kanikama_weights. What is
/// not finite becomes 0.
Image<float> kanikama_ratio(const LightPair& pair);

/// Luminance weights of that shader, UnityCG's for linear colours of before HDR.
inline constexpr double kanikama_weights[3] = {0.0396819152, 0.458021790, 0.00609653955};

/// A line for everything in `faults` that the user of the lightmaps should know; `name` begins each.
std::vector<std::string> describe(const LightmapFaults& faults, const std::string& name, const Coverage& coverage);

}  // namespace surimi
