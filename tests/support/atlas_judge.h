// SPDX-License-Identifier: Apache-2.0
// Whether an atlas is fit for a lightmap, by rules written here: shares no code with the unwrapper.
#pragma once

#include <string>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi::test {

/// What an atlas of one map may not have; empty when it is fit. Exact, since uv are whole numbers of 2^-24.
/// - a surface without its uv, a triangle of a chart that is not there or belongs to another surface
/// - uv that are not finite, outside [0, 1], or no whole number of 2^-24
/// - a triangle without area, or turned against the others of its chart
/// - two triangles, of one chart or of two, that share area
/// - touched texels of two charts with less than atlas.gutter untouched ones between them
std::vector<std::string> faults_of(const Scene& scene, const Atlas& atlas);

/// How much a chart is stretched, against its own density.
struct Stretch {
    double dirichlet = 4;       ///< mean symmetric Dirichlet energy by area: 4 without stretch
    double lowest_density = 1;  ///< in the worst direction, of the 1 % of the area where that is lowest
};

/// Of each chart with a density that is a texel wide and high: smaller ones may be widened. Triangles lower than 1/32
/// texel are left out, since rounding to 2^-24 shows in them.
std::vector<Stretch> stretches_of(const Scene& scene, const Atlas& atlas);

}  // namespace surimi::test
