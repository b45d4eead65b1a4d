// SPDX-License-Identifier: Apache-2.0
// Points lit as other programs light them.
#pragma once

#include "runtime/shade/shade.h"

namespace surimi {

/// As `shade`, with the formulae of Kanikama's shader or of three.js, on our fit of the lobes (their table's numbers
/// are not ours to give away), in float: monitors shine to their front only, panels count as quads, V from the map is
/// multiplied with both parts, the diffuse part gives nothing up to the specular one (Kanikama takes Unity's constant
/// 0.04 off), and three.js shows roughnesses below 0.045 as that (what it adds where normals bend depends on the size
/// of a pixel, and is left out). Stochastic visibility and pictures are left out: neither program has them per monitor.
/// Where the formulae give no number, nothing is added and `not_finite` counted.
void shade_as_published(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
                        std::span<MonitorCounts> counts);

}  // namespace surimi
