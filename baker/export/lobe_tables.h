// SPDX-License-Identifier: Apache-2.0
// The table of lobes as a texture, for shaders that integrate over monitors themselves.
#pragma once

#include <cstdint>
#include <vector>

namespace surimi {

/// Three tables of ltc_size x ltc_size one below the other (M27), column by perceptual roughness, row by
/// sqrt(1 - N.V): the numbers of the full lobe (along, lift, skew, depth), those of Schlick's, and albedo and
/// fresnel_root with two zeros. Four 32-bit floats a texel, little-endian, first row first. No image file, since
/// programs that Godot exports read no EXR, and PNG holds no floats.
std::vector<uint8_t> lobe_tables();

}  // namespace surimi
