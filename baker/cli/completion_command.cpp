// SPDX-License-Identifier: Apache-2.0
// Completion for shells, from the same description of options that --help prints.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "baker/cli/commands.h"
#include "baker/cli/help.h"

namespace surimi {
namespace {

/// An option as a shell needs it.
struct Completion {
    std::string name;  ///< with its dashes
    std::string description;
    std::string argument;  ///< empty: a flag
    std::vector<std::string> choices;
};

std::vector<Completion> completions_of(const CLI::App& command) {
    std::vector<Completion> completions;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            completions.push_back({"--" + name, option->get_description(), argument_of(*option), choices_of(*option)});
    return completions;
}

std::vector<std::string> names_of(const std::vector<Completion>& completions) {
    std::vector<std::string> names;
    for (const Completion& completion : completions) names.push_back(completion.name);
    return names;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    return names;
}

/// The beginning of a description, without what shells would take for quotes or markup.
std::string plain(const std::string& description) {
    std::string kept;
    for (const char c : description.substr(0, std::min(description.find(": "), description.find("; "))))
        if (std::string_view("'[]:\\").find(c) == std::string_view::npos) kept += c;
    return kept;
}

std::string for_bash(const std::vector<const CLI::App*>& commands) {
    std::string values, options;
    for (const CLI::App* command : commands) {
        const auto completions = completions_of(*command);
        for (const Completion& completion : completions)
            if (!completion.choices.empty())
                values += fmt::format("        '{} {}') words='{}' ;;\n", command->get_name(), completion.name,
                                      fmt::join(completion.choices, " "));
            else if (!completion.argument.empty())
                values += fmt::format("        '{} {}') return ;;\n", command->get_name(), completion.name);
        options +=
            fmt::format("            {}) words='{}' ;;\n", command->get_name(), fmt::join(names_of(completions), " "));
    }
    return fmt::format(R"(# bash completion of surimi: source this file, or put it into /etc/bash_completion.d
_surimi() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} words=''
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W '{}' -- "$current")
        return
    fi
    case "${{COMP_WORDS[1]}} $previous" in
{}        *)
            [[ $current == -* ]] || return
            case ${{COMP_WORDS[1]}} in
{}            esac
            ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _surimi surimi
)",
                       fmt::join(names_of(commands), " "), values, options);
}

std::string for_zsh(const std::vector<const CLI::App*>& commands) {
    std::string names, options;
    for (const CLI::App* command : commands) {
        names += fmt::format("        '{}:{}'\n", command->get_name(), plain(command->get_description()));
        options += fmt::format("            {}) _arguments", command->get_name());
        for (const Completion& completion : completions_of(*command)) {
            options += fmt::format(" \\\n                '{}[{}]", completion.name, plain(completion.description));
            if (!completion.choices.empty())
                options += fmt::format(":value:({})'", fmt::join(completion.choices, " "));
            else
                options += completion.argument.empty() ? "'" : ":value:_files'";
        }
        options += " \\\n                '*:file:_files' ;;\n";
    }
    return fmt::format(R"(#compdef surimi
# zsh completion of surimi: put it as _surimi into a folder of $fpath
_surimi() {{
    local -a commands=(
{}    )
    if ((CURRENT == 2)); then
        _describe 'command' commands
    else
        local command=$words[2]
        shift words
        ((CURRENT--))
        case $command in
{}        esac
    fi
}}
_surimi "$@"
)",
                       names, options);
}

std::string for_fish(const std::vector<const CLI::App*>& commands) {
    std::string text = "# fish completion of surimi: put it as surimi.fish into ~/.config/fish/completions\n";
    for (const CLI::App* command : commands) {
        const std::string name = command->get_name();
        text += fmt::format("complete -c surimi -n __fish_use_subcommand -a {} -d '{}'\n", name,
                            plain(command->get_description()));
        for (const Completion& completion : completions_of(*command)) {
            text += fmt::format("complete -c surimi -n '__fish_seen_subcommand_from {}' -l {} -d '{}'", name,
                                completion.name.substr(2), plain(completion.description));
            if (!completion.choices.empty())
                text += fmt::format(" -x -a '{}'", fmt::join(completion.choices, " "));
            else if (!completion.argument.empty())
                text += " -r";
            text += "\n";
        }
    }
    return text;
}

}  // namespace

Run add_completion_command(CLI::App& app) {
    const auto shell = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("completion", "Completion of commands and options for a shell");
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->type_name("")
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    return [shell, &app] {
        const auto commands = std::as_const(app).get_subcommands({});
        fmt::print("{}", *shell == "bash"  ? for_bash(commands)
                         : *shell == "zsh" ? for_zsh(commands)
                                           : for_fish(commands));
        return 0;
    };
}

}  // namespace surimi
