// SPDX-License-Identifier: Apache-2.0
// A finished bake on disk: its manifest, and the files that it names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace surimi {

/// A monitor as the manifest has it.
struct BakedMonitor {
    int channel = 0;  ///< 0, 1, 2 for R, G, B
    std::string name;
};

/// The files of one page of the atlas; empty paths: not there.
struct PageOfBake {
    std::filesystem::path visibility_exr;
    std::filesystem::path visibility_png;
    std::filesystem::path lightmaps_exr;
};

struct BakeFiles {
    std::filesystem::path manifest_path;
    nlohmann::ordered_json manifest;
    std::string name;  ///< of the scene, without extension
    int width = 0;     ///< of each page, texels
    int height = 0;
    std::vector<BakedMonitor> monitors;
    std::vector<PageOfBake> pages;  ///< at least one
    std::filesystem::path baked_glb;
    std::vector<std::string> complaints;  ///< files that are not there, or are not those that the bake wrote
};

/// Manifests of bakes in a folder, by name.
std::vector<std::filesystem::path> manifests_in(const std::filesystem::path& folder);

enum class OutputState { whole, changed, missing };

/// Whether a file is the one with this content_hash().
OutputState state_of_output(const std::filesystem::path& path, const std::string& hash);

/// Finds the bake in a folder, or the one of a manifest. Files that are missing are complaints, no errors. Throws
/// Error(scene) when there is no manifest, or none that this program understands, and Error(usage) when the folder has
/// several.
BakeFiles find_bake(const std::filesystem::path& folder_or_manifest);

}  // namespace surimi
