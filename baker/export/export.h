// SPDX-License-Identifier: Apache-2.0
// A finished bake -> a folder for each engine: the map as its shader wants it, what reads it, and how to put it in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surimi {

/// An engine or shader that a bake can be handed to.
struct ExportTarget {
    std::string name;  ///< on the command line, and of its folder
    std::string what;  ///< for people
};

const std::vector<ExportTarget>& export_targets();

/// Writes export/TARGET/ beside the manifest for each of `targets` (names of export_targets, each once), from the
/// files of the bake alone. `folder_or_manifest`: as find_bake takes it. All files appear, or none; those of earlier
/// exports are overwritten. Returns their paths. What was changed since the bake is added to `warnings`. Throws
/// Error(scene) for a bake whose files are missing or are none, Error(usage) for one that the target cannot show, and
/// Error(cannot_write).
std::vector<std::filesystem::path> export_bake(const std::filesystem::path& folder_or_manifest,
                                               const std::vector<std::string>& targets,
                                               std::vector<std::string>& warnings);

}  // namespace surimi
