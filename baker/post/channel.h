// SPDX-License-Identifier: Apache-2.0
// One monitor's visibility on one page of the atlas, and what each texel of it is.
#pragma once

#include <cstdint>

#include "runtime/base/image.h"

namespace surimi {

/// What a texel of one channel is. The values are those of the `state` layer in the lightmaps file.
enum class TexelState : uint8_t {
    empty = 0,    ///< no chart here or near
    covered = 1,  ///< measured
    unlit = 2,    ///< on a surface that this monitor cannot light; its value comes from neighbours
    filled = 3,   ///< gutter: its value comes from the chart beside it
    inside = 4,   ///< on a surface that other geometry encloses; its value comes from neighbours
};

struct Channel {
    Image<float> visibility;  ///< [0, 1]; 1 where not covered
    Image<TexelState> state;
};

}  // namespace surimi
