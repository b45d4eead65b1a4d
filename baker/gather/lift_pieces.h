// SPDX-License-Identifier: Apache-2.0
// Texels of coarse smooth surfaces, moved off their facets where nothing is in the way (M63).
#pragma once

#include <span>

#include "baker/gather/panel.h"
#include "baker/texel/texel_surface.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Lifts those pieces whose triangles bulge (baker/texel/lift.h). A piece stays where it is, as a whole, where a ray
/// from its middle or a corner to the place that this would move to meets something, or where something stands between
/// it and one of the panels closer than sixteen times what it would move: off its facet, it would look over that.
void lift_pieces(const RayScene& rays, std::span<const Panel> panels, TexelSurface& surface);

}  // namespace surimi
