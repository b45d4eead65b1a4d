// SPDX-License-Identifier: Apache-2.0
// Texels without a value of their own get one from their neighbours.
#pragma once

#include <cstdint>

#include "baker/texel/texels.h"
#include "baker/unwrap/atlas.h"
#include "runtime/base/image.h"

namespace surimi {

/// What a texel of one channel is. The values are those of the `state` layer in the lightmaps file.
enum class TexelState : uint8_t {
    empty = 0,    ///< no chart here or near
    covered = 1,  ///< measured
    unlit = 2,    ///< on a surface that this monitor cannot light; its value comes from neighbours
    filled = 3,   ///< gutter: its value comes from the chart beside it
};

/// Gives unlit texels the value of the measured texels nearest on their chart, or of their surface where the chart has
/// none, or 1 (nothing known to block) where the monitor lights no texel of the surface; then extends every chart into
/// its gutter and beyond, until the map is full. Rounds are double-buffered, so no scan order shows.
/// `visibility` and `state` have the size of the atlas; gutter texels become `filled`.
void fill(const Atlas& atlas, const Texels& texels, Image<float>& visibility, Image<TexelState>& state);

}  // namespace surimi
