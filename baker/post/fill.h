// SPDX-License-Identifier: Apache-2.0
// Texels without a value of their own get one from their neighbours.
#pragma once

#include "baker/post/channel.h"
#include "baker/texel/texels.h"
#include "baker/unwrap/atlas.h"

namespace surimi {

/// Gives unlit texels the value of the measured texels nearest on their chart, or of their surface where the chart has
/// none, or 1 (nothing known to block) where the monitor lights no texel of the surface; then extends every chart into
/// its gutter and beyond, until the map is full. Rounds are double-buffered, so no scan order shows.
/// `visibility` and `state` have the size of the atlas; gutter texels become `filled`.
void fill(const Atlas& atlas, const Texels& texels, Image<float>& visibility, Image<TexelState>& state);

}  // namespace surimi
