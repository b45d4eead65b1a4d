// SPDX-License-Identifier: Apache-2.0
// Pictures of a scene as files.
#pragma once

#include <filesystem>

#include "runtime/preview/render.h"

namespace surimi {

/// Writes `pixels` (linear; lit views: nits), by the extension: .exr as they are, .png as a screen shows them, exposed.
/// Throws Error(cannot_write).
void write_picture(const std::filesystem::path& path, const Image<Vec3f>& pixels, Show show, double exposure);

}  // namespace surimi
