// SPDX-License-Identifier: Apache-2.0
// A lightmap that another program baked, and the two of them that make a visibility map's channel.
#pragma once

#include "runtime/base/image.h"

namespace surimi {

/// One monitor's light, alone, direct, without textures; linear, in any unit.
struct Lightmap {
    Image<float> light;        ///< luminance
    Image<float> alpha;        ///< [0, 1]; empty: the file has none
    double code_step = 0;      ///< between neighbouring codes of [0, 1], of formats of integers
    bool is_srgb = false;      ///< those codes are sRGB's
    double relative_step = 0;  ///< between neighbouring values as a share of them, of formats of floats
};

/// How far apart the values are that the file could hold near `light`.
double step_at(const Lightmap& lightmap, double light);

/// The same monitor's light with everything that stands in its way, and with nothing; of one size.
struct LightPair {
    Lightmap shadowed;
    Lightmap unshadowed;
};

}  // namespace surimi
