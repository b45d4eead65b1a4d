// SPDX-License-Identifier: Apache-2.0
// The UVs that a file brings along -> Atlas, after checking that a lightmap can use them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/error.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

/// TEXCOORD_1 of a scene, and what speaks against it.
struct ExistingUv {
    Atlas atlas;        ///< empty where a surface has no TEXCOORD_1. Triangles that are not finite lie in the origin
    std::string fault;  ///< in words, with surfaces and triangles; empty: fit for a lightmap
    ErrorKind kind = ErrorKind::scene;  ///< of the fault
    std::vector<TriangleRef> bad;       ///< triangles at fault, sorted
    std::vector<uint32_t> shared;       ///< texels (y * width + x) that bilinear reads on two charts touch, sorted
};

/// Judges TEXCOORD_1 of every surface that receives. At fault are: values that are missing, not finite or outside [0,
/// 1]; triangles that deserve a texel and have no area on the map; triangles that overlap, also those of two surfaces;
/// charts that share a texel of their bilinear footprints at the map's size (as Unity judges lightmap UVs), with the
/// next doubled size at which they do not. Charts are triangles joined by edges whose ends agree in place and uv, also
/// across surfaces. A gap narrower than the gutter asked for, or none left on the last mip level asked for, is a
/// warning in `atlas`. With a density, the map becomes the smallest square multiple of 4 at which the scene has it on
/// average. Near-linear in triangles and texels.
ExistingUv judge_existing(const Scene& scene, const UnwrapSettings& settings);

/// The existing UVs where `settings.uv` asks for them. Nothing for UvSource::unwrap, and nothing for automatic when
/// they are unfit or several atlases are asked for: then `why_not` says why. Throws Error(scene), or Error(usage) where
/// the density makes the map too large, when UvSource::existing asks for UVs that are unfit.
std::optional<Atlas> take_existing(const Scene& scene, const UnwrapSettings& settings, std::string& why_not);

}  // namespace surimi
