// SPDX-License-Identifier: Apache-2.0
// The table of lobes as textures, for shaders that integrate over monitors themselves.
#pragma once

#include "runtime/image/image_file.h"

namespace surimi {

/// Three pictures of ltc_size x ltc_size, channels R G B A, column by perceptual roughness, row by sqrt(1 - N.V), top
/// row first (M27): the numbers of the full lobe (along, lift, skew, depth), those of Schlick's, and albedo and
/// fresnel_root with two zeros.
Channels full_lobe_texture();
Channels schlick_lobe_texture();
Channels albedo_texture();

}  // namespace surimi
