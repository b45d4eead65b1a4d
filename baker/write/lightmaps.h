// SPDX-License-Identifier: Apache-2.0
// The evidence behind a map: for every monitor, what arrives with and without shadows, how sure that is, and
// where.
#pragma once

#include <span>

#include "baker/bake.h"
#include "runtime/image/image_file.h"

namespace surimi {

/// For every monitor the channels NAME.shadowed and NAME.unshadowed (texel averages of S and E at unit
/// radiance, W/m^2 per W/m^2/sr), NAME.error (standard error of S / E), NAME.method and NAME.state (the numbers of
/// TexelMethod and TexelState). NAME is the monitor's, with its channel added ("TV_G") where two monitors share a name.
ChannelLayout lightmap_layout(const Scene& scene, const BakedPage& page);

/// Their values from this row of the page on, as many as `values` holds.
void give_lightmaps(const Scene& scene, const BakedPage& page, int begin, std::span<float> values);

}  // namespace surimi
