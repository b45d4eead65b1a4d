// SPDX-License-Identifier: Apache-2.0
// The settings of a bake as a user would give them again: as a command and as TOML.
#pragma once

#include <string>

#include "baker/write/bake_files.h"

namespace surimi {

/// "surimi bake room.glb --size 1024 1024 ..." with every setting of the manifest, for a POSIX shell. Where a command
/// cannot say all of them, it refers to the file that toml_of is the content of.
std::string command_of(const BakeFiles& bake);

/// The content of a NAME.surimi.toml with all settings of the manifest and its monitors.
std::string toml_of(const BakeFiles& bake);

}  // namespace surimi
