// SPDX-License-Identifier: Apache-2.0
// The files of an unwrap. All of them appear, or none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "baker/write/unwrap_report.h"
#include "runtime/base/parallel.h"

namespace surimi {

struct UnwrapOutput {
    std::vector<std::filesystem::path> paths;
    std::string report;  ///< the content of NAME.unwrap.json
};

/// Writes `folder`/NAME.unwrapped.glb (the scene plus TEXCOORD_1), NAME.charts.png, NAME.density.png, NAME.stretch.png
/// (with several pages NAME.charts.0.png and so on) and NAME.unwrap.json, NAME being the scene file's stem. Makes the
/// folder if need be. Throws Error(cannot_write) and Error(interrupted), leaving no half file behind.
UnwrapOutput write_unwrap(const std::filesystem::path& folder, const Scene& scene, const Unwrapped& unwrapped,
                          const Progress& progress);

/// Writes the glb alone. Throws Error(cannot_write), and Error(usage) when `file` is the input.
UnwrapOutput write_unwrapped_glb(const std::filesystem::path& file, const Scene& scene, const Unwrapped& unwrapped);

}  // namespace surimi
