// SPDX-License-Identifier: Apache-2.0
// Texels without a value of their own get one from what is near them in the world.
#pragma once

#include <span>

#include "baker/post/channel.h"
#include "baker/post/settings.h"
#include "baker/texel/texels.h"
#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Gives the texels of one monitor that are unlit or inside a value; their states stay. `pages` and `channels` are by
/// page, of one length; channels have the atlas' size. The first of these that there is:
/// 1. within four rings of a covered texel, as far as anything that is lit reads: the mean of the covered texels
///    within four texels in the world on the same side of the surface, of whatever chart, surface or page (M62);
/// 2. what grows there through the texel's own chart from texels that are covered or have the first;
/// 3. the mean of the surface's covered texels;
/// 4. 1, nothing known to block, where the monitor lights no texel of the surface.
/// Texels inside other geometry more than settings.inside_rings from any covered one that is mostly free are 0 instead.
/// With settings.fills_in_space off, 2 to 4 alone. Means are of measured values and rings of growth are
/// double-buffered, so neither scan order nor the number of threads shows. Texels outside the charts are left to
/// grow_gutters().
void fill(const Scene& scene, const Atlas& atlas, std::span<const Texels> pages, std::span<Channel> channels,
          const PostSettings& settings);

}  // namespace surimi
