// SPDX-License-Identifier: Apache-2.0
// Image files that the user names, as linear colours.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/base/image.h"
#include "runtime/base/math.h"

namespace surimi {

/// Linear colours of an image file. EXR, HDR and PFM hold them; everything else is taken for sRGB codes. `channel`
/// names a channel that stands for all three, or a layer; empty: R, G and B, or the only channel. Throws Error(scene)
/// for a file that cannot be read, Error(usage) for one without such channels.
Image<Vec3f> read_colors(const std::filesystem::path& path, const std::string& channel = "");

}  // namespace surimi
