// SPDX-License-Identifier: Apache-2.0
// Texels of coarse smooth surfaces, moved off their facets where nothing is in the way (M63).
#pragma once

#include "baker/texel/texel_surface.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Lifts those pieces whose triangles bulge (baker/texel/lift.h). A piece stays where it is, as a whole, where a ray
/// from its middle or a corner to the place that this would move to meets something.
void lift_pieces(const RayScene& rays, TexelSurface& surface);

}  // namespace surimi
