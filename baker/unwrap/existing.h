// SPDX-License-Identifier: Apache-2.0
// The UVs that a file brings along -> Atlas, after checking that a lightmap can use them.
#pragma once

#include "baker/unwrap/atlas.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Takes TEXCOORD_1 of every surface as it is; with a density, the map becomes the smallest square multiple
/// of 4 at which the scene has it on average. Gaps between charts are the file's business and are not judged.
/// Throws Error(scene), naming surface and triangles, when a surface has no TEXCOORD_1 or its values are not
/// finite, outside [0, 1], or overlap, also with those of another surface.
Atlas take_existing(const Scene& scene, const UnwrapSettings& settings);

}  // namespace surimi
