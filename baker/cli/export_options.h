// SPDX-License-Identifier: Apache-2.0
// --export: the engines that a bake is handed to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace surimi {

void add_export_option(CLI::App& app, std::vector<std::string>& targets);

/// What there is, for help: "kanikama: Unity with ...; ltcgi: ...".
std::string export_help();

/// Each once, in the order of the program. Throws Error(usage), starting with `source`, for unknown names, with the
/// nearest.
std::vector<std::string> parse_export_targets(const std::vector<std::string>& names, const std::string& source);

/// export_bake; tells stderr what it warns of, unless quiet. Nothing happens without targets.
std::vector<std::filesystem::path> export_from(const std::filesystem::path& bake,
                                               const std::vector<std::string>& targets, bool is_quiet);

}  // namespace surimi
