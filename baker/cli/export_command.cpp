// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "baker/cli/commands.h"
#include "baker/cli/export_options.h"

namespace surimi {
namespace {

struct ExportOptions {
    std::filesystem::path bake;
    std::vector<std::string> targets;
    bool quiet = false;
};

}  // namespace

Run add_export_command(CLI::App& app) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App* command = app.add_subcommand("export", "Hand a finished bake to Unity, Godot or three.js");
    command->add_option("bake", options->bake, "Folder of a bake, or its NAME.visibility.json")
        ->required()
        ->type_name("BAKE");
    command->add_option("target", options->targets, "Writes export/TARGET in the bake's folder. " + export_help())
        ->required()
        ->type_name("TARGET...");
    command->add_flag("--quiet", options->quiet, "No messages; errors only");
    return [options] {
        const auto targets = parse_export_targets(options->targets, "surimi export");
        for (const auto& path : export_from(options->bake, targets, options->quiet)) fmt::print("{}\n", path.string());
        return 0;
    };
}

}  // namespace surimi
