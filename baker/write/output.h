// SPDX-License-Identifier: Apache-2.0
// The files of a finished bake. All of them appear, or none.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "baker/bake.h"

namespace surimi {

/// The files that every page of the atlas has.
struct PagePaths {
    std::filesystem::path visibility_exr;
    std::filesystem::path visibility_png;
    std::filesystem::path lightmaps_exr;
};

struct OutputPaths {
    std::vector<PagePaths> pages;
    std::filesystem::path baked_glb;
    std::filesystem::path manifest_json;

    std::vector<std::filesystem::path> all() const;
};

/// `out`/NAME.visibility.exr and so on, NAME being the scene file's stem; with several pages NAME.visibility.0.exr,
/// NAME.visibility.1.exr and so on.
OutputPaths output_paths(const std::filesystem::path& out, const std::filesystem::path& scene, size_t page_count);

/// Makes the folder if need be, writes every file under a temporary name, reads each back, and renames them when all
/// are there. Throws Error(cannot_write), leaving no half file and no temporary behind; refuses to overwrite the input.
OutputPaths write_bake(const std::filesystem::path& out, const Scene& scene, const Bake& bake,
                       const std::string& settings_json);

}  // namespace surimi
