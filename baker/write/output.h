// SPDX-License-Identifier: Apache-2.0
// The files of a finished bake. All of them appear, or none.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "baker/bake.h"

namespace surimi {

struct OutputPaths {
    std::filesystem::path visibility_exr;
    std::filesystem::path visibility_png;
    std::filesystem::path lightmaps_exr;
    std::filesystem::path baked_glb;
    std::filesystem::path manifest_json;
};

/// `out`/NAME.visibility.exr and so on, NAME being the scene file's stem.
OutputPaths output_paths(const std::filesystem::path& out, const std::filesystem::path& scene);

/// Makes the folder if need be, writes every file under a temporary name, reads each back, and renames them when all
/// are there. Throws Error(cannot_write), leaving no half file and no temporary behind; refuses to overwrite the input.
OutputPaths write_bake(const std::filesystem::path& out, const Scene& scene, const Bake& bake,
                       const std::string& settings_json);

}  // namespace surimi
