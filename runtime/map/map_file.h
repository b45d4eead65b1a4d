// SPDX-License-Identifier: Apache-2.0
// The files of a visibility map. One place knows the formats; reading inverts writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "runtime/image/image_file.h"
#include "runtime/map/visibility_map.h"

namespace surimi {

/// Size and channels of a map's EXR.
ChannelLayout map_layout(const VisibilityMap& map);
/// Their values from this row of the map on, as many as `values` holds.
void give_map(const VisibilityMap& map, int begin, std::span<float> values);

/// Half, ZIP, linear, channels R G B. Throws Error(cannot_write).
void write_map_exr(const std::filesystem::path& path, const VisibilityMap& map);

/// 8-bit, sRGB-encoded PNG. A linear 8-bit map bands by 12 display codes in deep shadow, this one by 1.
std::vector<uint8_t> encode_map_png(const VisibilityMap& map);

/// Reads R, G, B of an EXR. Throws Error(scene) for a file without them, or with values outside [0, 1] or not finite.
VisibilityMap read_map_exr(const std::filesystem::path& path);

/// The map in an 8-bit image as a baked glb carries it.
VisibilityMap map_from_image(const Image<glm::u8vec4>& image, bool is_srgb);

}  // namespace surimi
