// SPDX-License-Identifier: Apache-2.0
// --without: the fixes that a bake shall do without.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "baker/settings.h"

namespace CLI {
class App;
}

namespace surimi {

void add_fix_options(CLI::App& app, std::vector<std::string>& without);

/// The names in SURIMI_WITHOUT, separated by commas.
std::vector<std::string> environment_without();

/// Turns the named fixes off, and all others on: one source replaces what a lower one said. Throws Error(usage),
/// starting with `source`, for unknown names.
void do_without(const std::vector<std::string>& names, const std::string& source, BakeSettings& settings);

/// Names of the fixes that are off.
std::vector<std::string> without(const BakeSettings& settings);

/// The line of TOML that gives the same settings when it is read.
std::string fixes_toml(const BakeSettings& settings);

}  // namespace surimi
