// SPDX-License-Identifier: Apache-2.0
// Charts extended beyond their borders, so that bilinear reads and mips at a border meet the chart's own values.
#pragma once

#include "baker/post/channel.h"
#include "baker/post/growth.h"
#include "baker/texel/texels.h"
#include "baker/unwrap/atlas.h"

namespace surimi {

/// Extends every chart of one page into what is empty around it, by the chart's own values, until `rings` rings lie
/// around it or (all_rings) the map is full. Every texel of `texels` has a value already, measured or filled; each
/// gutter texel belongs to one chart, the nearest, and becomes `filled`. Those that are `filled` before the call keep
/// their values, and the rings beyond go on from them: 1 ring, something that changes it, and then all rings is as
/// good as all rings of the changed map. A page without a chart stays as it is.
void grow_gutters(const Texels& texels, Channel& channel, int rings);

}  // namespace surimi
