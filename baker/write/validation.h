// SPDX-License-Identifier: Apache-2.0
// Whether the files of a bake are whole, belong together and say the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surimi {

struct Validation {
    std::vector<std::filesystem::path> files;  ///< that were looked at
    std::vector<std::string> faults;           ///< a line each; empty: all is well
};

/// Checks a bake by its manifest: every file is there with its size and hash; maps are finite, within [0, 1] and of the
/// size said, 1 in channels without a monitor, and the same in EXR and PNG within a code; states are counted as said;
/// the baked scene can be read and carries a map for the monitors said. Throws Error(scene) where the manifest itself
/// cannot be read.
Validation validate_bake(const std::filesystem::path& manifest);

/// The manifest that `path` names: itself, or the only NAME.visibility.json of a folder. Throws Error(usage) where
/// there is none, or several.
std::filesystem::path find_manifest(const std::filesystem::path& path);

}  // namespace surimi
