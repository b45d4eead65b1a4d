// SPDX-License-Identifier: Apache-2.0
// Scene -> Atlas.
#pragma once

#include "baker/unwrap/atlas.h"
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
    int atlases = 1;              ///< maps to spread the surfaces over, each of the size above
    double stretch = 1.5;         ///< above 1: 99 % of a chart's area has at least 1 / stretch of its density in every
                                  ///< direction, and its mean symmetric Dirichlet energy is at most
                                  ///< 4 + 0.4 (stretch - 1)^2
    UvQuality quality = UvQuality::medium;
};

/// Cuts every surface into charts without flips or overlaps, at one density, and packs them into exactly the size
/// asked for. Deterministic. Adds nothing to the scene and drops nothing with area.
/// Throws Error(nothing_to_bake) when the scene has no triangle, Error(usage) when the charts cannot fit even at the
/// lowest density (it names the smallest size that can), Error(scene) when existing UVs are asked for
/// and unfit (see judge_existing): the message names surface and triangles.
Atlas unwrap(const Scene& scene, const UnwrapSettings& settings, const Progress& progress);

}  // namespace surimi
