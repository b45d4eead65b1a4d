// SPDX-License-Identifier: Apache-2.0
// What --help shows: the options of every day on one screen, the others with --help-all.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace surimi {

/// Gives the program and its subcommands their help: --help-all, the group of options that few need, lines that fit the
/// terminal ($COLUMNS, else 100 columns). To be called once all subcommands are there.
void set_up_help(CLI::App& app);

/// The words that an option takes, such as auto, split; none where it takes anything.
std::vector<std::string> choices_of(const CLI::Option& option);

/// What an option takes as its help names it, such as FILE, without its environment variable; empty: it is a flag.
std::string argument_of(const CLI::Option& option);

}  // namespace surimi
