// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <exception>
#include <vector>

#include "baker/cli/commands.h"
#include "baker/cli/config_file.h"
#include "baker/cli/help.h"
#include "runtime/base/error.h"

namespace {

using surimi::ErrorKind;

constexpr const char* footer =
    "Exit codes: 0 ok, 1 internal error, 2 usage or configuration, 3 the scene cannot be read or is invalid,\n"
    "4 nothing to bake or ambiguous monitors, 5 a comparison above its limit, or with --strict an error above the one\n"
    "asked for, 6 cannot write, 130 interrupted.\n"
    "Start here: surimi inspect room.glb, then surimi bake room.glb -o out, then surimi preview out/room.baked.glb -o "
    "room.png";

/// CLI11's own message, and the nearest name when a word was not understood.
int usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    fmt::print(stderr, "surimi: {}\n", error.what());
    std::vector<std::string> names;
    const CLI::App* scope = &app;
    for (const CLI::App* chosen : app.get_subcommands()) scope = chosen;
    for (const CLI::App* sub : scope->get_subcommands({})) names.push_back(sub->get_name());
    for (const CLI::Option* option : scope->get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (int i = 1; i < argc; ++i) {
        const std::string word(argv[i]);
        const bool is_option = word.rfind("--", 0) == 0;
        const bool is_command = i == 1 && scope == &app;
        if ((is_option || is_command) &&
            std::find(names.begin(), names.end(), word.substr(0, word.find('='))) == names.end() && !names.empty()) {
            fmt::print(stderr, "did you mean {}?\n", surimi::nearest(word, names));
            break;
        }
    }
    fmt::print(stderr, "surimi {}--help lists what there is\n", scope == &app ? "" : scope->get_name() + " ");
    return static_cast<int>(ErrorKind::usage);
}

int run(int argc, char** argv) {
    CLI::App app("Surimi bakes visibility maps for monitor light.", "surimi");
    app.set_version_flag("--version", "surimi " SURIMI_VERSION);
    app.footer(footer);
    app.require_subcommand(1);
    std::vector<std::pair<const CLI::App*, surimi::Run>> commands;
    for (const auto add :
         {surimi::add_inspect_command, surimi::add_unwrap_command, surimi::add_bake_command,
          surimi::add_preview_command, surimi::add_compare_command, surimi::add_study_command, surimi::add_plan_command,
          surimi::add_ratio_command, surimi::add_report_command, surimi::add_export_command,
          surimi::add_validate_command, surimi::add_doctor_command, surimi::add_completion_command}) {
        const surimi::Run command = add(app);
        commands.emplace_back(app.get_subcommands({}).back(), command);
    }
    surimi::set_up_help(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {  // --help, --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        return usage_error(app, error, argc, argv);
    }
    for (const auto& [command, execute] : commands)
        if (command->parsed()) return execute();
    return static_cast<int>(ErrorKind::usage);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const surimi::Error& error) {
        fmt::print(stderr, "surimi: {}\n", error.what());
        return static_cast<int>(error.kind());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "surimi: out of memory; a smaller --size needs less\n");
        return static_cast<int>(ErrorKind::internal);
    } catch (const std::exception& error) {
        fmt::print(stderr, "surimi: internal error: {}\n", error.what());
        return static_cast<int>(ErrorKind::internal);
    }
}
