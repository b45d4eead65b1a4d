// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/export_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "baker/cli/config_file.h"
#include "baker/export/export.h"
#include "runtime/base/error.h"

namespace surimi {

std::string export_help() {
    std::string text;
    for (const ExportTarget& target : export_targets())
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", target.name, target.what);
    return text;
}

void add_export_option(CLI::App& app, std::vector<std::string>& targets) {
    app.add_option("--export", targets, "Write FOLDER/export/TARGET too; repeatable. " + export_help())
        ->type_name("TARGET")
        ->delimiter(',')
        ->expected(1)
        ->take_all();
}

std::vector<std::string> parse_export_targets(const std::vector<std::string>& names, const std::string& source) {
    std::vector<std::string> known, targets;
    for (const ExportTarget& target : export_targets()) known.push_back(target.name);
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(ErrorKind::usage, fmt::format("{}: there is no target \"{}\"; did you mean {}? There are {}",
                                                      source, name, nearest(name, known), fmt::join(known, ", ")));
    for (const std::string& name : known)
        if (std::find(names.begin(), names.end(), name) != names.end()) targets.push_back(name);
    return targets;
}

std::vector<std::filesystem::path> export_from(const std::filesystem::path& bake,
                                               const std::vector<std::string>& targets, bool is_quiet) {
    if (targets.empty()) return {};
    std::vector<std::string> warnings;
    std::vector<std::filesystem::path> paths = export_bake(bake, targets, warnings);
    for (const std::string& warning : warnings)
        if (!is_quiet) fmt::print(stderr, "warning: {}\n", warning);
    return paths;
}

}  // namespace surimi
