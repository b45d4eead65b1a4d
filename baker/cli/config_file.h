// SPDX-License-Identifier: Apache-2.0
// NAME.surimi.toml: the settings that stay with a scene. The only file pair that sees toml++.
#pragma once

#include <filesystem>
#include <string>

#include "baker/cli/options.h"

namespace surimi {

/// Puts the file's values into `config`. Throws Error(usage) with file, line, and for an unknown key the nearest known.
void read_config_file(const std::filesystem::path& path, Config& config);

/// Throws Error(usage), starting with `source`, when a value is out of its range.
void check_ranges(const Config& config, const std::string& source);

/// Throws Error(usage), starting with `source`, for an unknown name.
UvSource parse_uv_source(const std::string& text, const std::string& source);
std::string name_of(UvSource uv);

/// Throws Error(usage), starting with `source`, for an unknown name.
UvQuality parse_uv_quality(const std::string& text, const std::string& source);
std::string name_of(UvQuality quality);

/// The candidate with the fewest edits from `word`.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace surimi
