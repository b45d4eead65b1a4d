// SPDX-License-Identifier: Apache-2.0
// Scene -> Atlas.
#pragma once

#include "baker/unwrap/atlas.h"
#include "baker/unwrap/texel_scale.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/scene.h"

namespace surimi {

enum class UvSource {
    unwrap,     ///< make new charts
    existing,   ///< take TEXCOORD_1 as it is, after checking it
    automatic,  ///< existing where it is fit for a lightmap, else new charts
};

/// How long the charts are tried to be made fewer and longer.
enum class UvQuality { draft, medium, high };

struct UnwrapSettings {
    UvSource uv = UvSource::unwrap;
    int width = 1024;  ///< texels; ignored with a density
    int height = 1024;
    double texels_per_metre = 0;  ///< 0: follows from the size. Otherwise the size follows (a multiple of 4, at most
                                  ///< 16384), and `width`, `height` are not used
    int gutter = 2;               ///< at least 1
    int mips = 0;                 ///< mip levels that gutters survive: one texel of gutter is left on level `mips`
    int atlases = 1;              ///< pages to spread the surfaces over, 1 to 64, each of the size above
    bool is_uniform = false;      ///< one density for all but texel scales: what the monitors light does not count
    double stretch = 1.5;         ///< above 1: 99 % of a chart's area has at least 1 / stretch of its density in every
                                  ///< direction, and its mean symmetric Dirichlet energy is at most
                                  ///< 4 + 0.4 (stretch - 1)^2
    UvQuality quality = UvQuality::medium;
    std::vector<TexelScale> texel_scales;  ///< densities that the user wants, besides extras.texel_scale
};

/// Cuts every surface that receives into charts without flips or overlaps, at one density, and packs them into exactly
/// the size asked for, or into several pages of that size. Deterministic. Adds nothing to the scene and drops nothing
/// with area. The density follows weigh_charts and texel_scales; existing UVs keep their own. Throws
/// Error(nothing_to_bake) when the scene has no triangle or no surface that receives, Error(usage) when the charts
/// cannot fit even at the lowest density (it names the smallest size that can) or a texel scale names nothing,
/// Error(scene) when existing UVs are asked for and unfit (see judge_existing): the message names surface and
/// triangles.
Atlas unwrap(const Scene& scene, const UnwrapSettings& settings, const Progress& progress);

}  // namespace surimi
