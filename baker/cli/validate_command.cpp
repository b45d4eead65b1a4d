// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>

#include "baker/cli/commands.h"
#include "baker/write/validation.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

int validate(const std::filesystem::path& path, bool as_json) {
    const std::filesystem::path manifest = find_manifest(path);
    const Validation validation = validate_bake(manifest);
    if (as_json) {
        fmt::print("{}\n", nlohmann::ordered_json{{"manifest", manifest.string()},
                                                  {"files", validation.files.size()},
                                                  {"faults", validation.faults}}
                               .dump(2));
    } else {
        for (const auto& file : validation.files) fmt::print("{}\n", file.string());
        for (const std::string& fault : validation.faults) fmt::print(stderr, "fault: {}\n", fault);
    }
    if (!validation.faults.empty())
        throw Error(ErrorKind::scene, fmt::format("{}: {} faults", manifest.string(), validation.faults.size()));
    return 0;
}

}  // namespace

Run add_validate_command(CLI::App& app) {
    const auto path = std::make_shared<std::filesystem::path>();
    const auto as_json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("validate", "Whether the files of a bake are whole and belong together");
    command->add_option("BAKE", *path, "Folder that bake wrote to, or its NAME.visibility.json")
        ->required()
        ->type_name("PATH");
    command->add_flag("--json", *as_json, "Print what was found as JSON");
    return [path, as_json] { return validate(*path, *as_json); };
}

}  // namespace surimi
