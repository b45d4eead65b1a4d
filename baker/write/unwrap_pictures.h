// SPDX-License-Identifier: Apache-2.0
// Pictures of an atlas: its charts, how dense and how stretched they are, and what is wrong with existing UVs.
#pragma once

#include "baker/unwrap/atlas.h"
#include "baker/unwrap/existing.h"
#include "runtime/base/image.h"
#include "runtime/scene/scene.h"

namespace surimi {

using Picture8 = Image<glm::u8vec3>;

// Pixels and texels: maps above 4096 texels are shown reduced by a whole factor. Charts and faults are enlarged to at
// least 2048 pixels by a whole factor, so that their outlines leave something of thin charts, heat maps to 512.

/// Charts of one page in the colours of Okabe and Ito 2008 and their shades; charts whose neighbourhoods on the map
/// meet differ. Seams between triangles that bend by less than smooth_bend, which show in a lightmap, are white, all
/// other sides of charts black, the rest dark.
Picture8 draw_charts(const Scene& scene, const Atlas& atlas, int page);

/// Texels a metre in the worst direction as a heat map: black 0 to pale yellow `high`; slate where there is no chart.
Picture8 draw_density(const Scene& scene, const Atlas& atlas, int page, double high);

/// How far each triangle is from lying undistorted at its chart's density, in the direction where it is farthest, as a
/// heat map: black 1 (not at all) to pale yellow `high`; slate where there is no chart.
Picture8 draw_stretch(const Scene& scene, const Atlas& atlas, int page, double high);

/// Existing UVs with what is wrong: triangles at fault magenta, texels that two charts share red. The map stands
/// framed in white when triangles leave it. `found.atlas` must not be empty.
Picture8 draw_faults(const ExistingUv& found);

}  // namespace surimi
