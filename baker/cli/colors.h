// SPDX-License-Identifier: Apache-2.0
// Image files that the user names, as linear colours.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/base/image.h"
#include "runtime/base/math.h"
#include "runtime/image/image_file.h"

namespace surimi {

/// What a file's channels hold, by its name: EXR, HDR and PFM linear values, everything else sRGB codes.
bool holds_linear_values(const std::filesystem::path& path);

/// Colours as the file holds them, of the channels that read_colors() takes.
Image<Vec3f> stored_colors(const std::filesystem::path& path, const Channels& channels, const std::string& channel);

/// Linear colours of an image file. EXR, HDR and PFM hold them; everything else is taken for sRGB codes. `channel`
/// names a channel that stands for all three, or a layer; empty: R, G and B, or the only channel. Throws Error(scene)
/// for a file that cannot be read, Error(usage) for one without such channels.
Image<Vec3f> read_colors(const std::filesystem::path& path, const std::string& channel = "");

/// Not 0 where any of R, G and B of the file is brighter than half; an empty path: an empty image. Throws as above.
Image<uint8_t> read_mask(const std::filesystem::path& path);

}  // namespace surimi
