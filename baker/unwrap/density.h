// SPDX-License-Identifier: Apache-2.0
// How many texels a metre of each surface deserves: far and large ones must not eat the map.
#pragma once

#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Density of each surface over the atlas' density, in (0, 1]; surfaces below 1 are listed in `caps` with the
/// reason.
///
/// The rule. All light of this map comes from the monitors. So the scene has a typical distance: the median
/// distance to the nearest monitor over all flux that leaves them, shadows left out (cosines at both ends,
/// inverse square). A surface that lies on average beyond three of those gets its density multiplied with the
/// square of (three typical distances over its mean distance): light falls off that fast, and the room around
/// the monitors is never further away. If such a surface still takes more than half of all texels, it is
/// brought down to half. Without monitors, or where nothing is lit, every factor is 1.
///
/// Measured at 1024 x 1024: the classroom's 49,000 m2 ground plane goes from 98 % of the charts' texels to
/// below 1 %, and the room from 4 to 25 texels a metre.
std::vector<double> density_factors(const Scene& scene, std::vector<DensityCap>& caps);

}  // namespace surimi
