// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/help.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <utility>

namespace surimi {
namespace {

constexpr const char* seldom = "More options";

/// Options of the bake and its relatives for which there is a good default, or which are for experts.
constexpr std::array<std::string_view, 22> seldom_needed = {"--glass",
                                                            "--density",
                                                            "--gutter",
                                                            "--mips",
                                                            "--atlases",
                                                            "--stretch",
                                                            "--uv-quality",
                                                            "--uniform",
                                                            "--exact",
                                                            "--method",
                                                            "--samples",
                                                            "--audit",
                                                            "--seed",
                                                            "--supersample",
                                                            "--memory",
                                                            "--without",
                                                            "--fit",
                                                            "--progress",
                                                            "--pixels-per-degree",
                                                            "--light-samples",
                                                            "--reference-samples",
                                                            "--metric"};

size_t columns_of_terminal() {
    const char* text = std::getenv("COLUMNS");
    size_t columns = 0;
    if (text) std::from_chars(text, text + std::string_view(text).size(), columns);
    return columns >= 60 ? columns : 100;
}

/// Breaks a text at blanks into lines of at most `width`.
std::vector<std::string> wrapped(const std::string& text, size_t width) {
    std::vector<std::string> lines;
    for (const std::string& word : CLI::detail::split(text, ' ')) {
        if (lines.empty() || lines.back().size() + 1 + word.size() > width)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    }
    return lines;
}

class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        shows_all_ = mode != CLI::AppFormatMode::Normal;
        command_ = app->get_name();
        return Formatter::make_help(app, std::move(name), mode);
    }

    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override {
        if (group == seldom && !shows_all_)
            return fmt::format("{} more options: surimi {} --help-all\n", options.size(), command_);
        return Formatter::make_group(std::move(group), is_positional, std::move(options));
    }

    std::string make_option(const CLI::Option* option, bool is_positional) const override {
        const std::string names = "  " + make_option_name(option, is_positional) + make_option_opts(option);
        const size_t left = get_column_width(), width = columns_of_terminal() - left;
        std::string text = names;
        size_t column = names.size();
        for (const std::string& line : wrapped(make_option_desc(option), width)) {
            if (column + 1 > left) text += "\n", column = 0;
            text += std::string(left - column, ' ') + line;
            column = left + line.size();
        }
        return text + "\n";
    }

    std::string make_subcommand(const CLI::App* command) const override {
        const size_t left = get_column_width();
        std::string name = "  " + command->get_display_name(true), text;
        for (const std::string& line : wrapped(command->get_description(), columns_of_terminal() - left)) {
            text += name + std::string(left - std::min(left, name.size()), ' ') + line + "\n";
            name.clear();
        }
        return text;
    }

  private:
    // Of the help that is being made: the library hands them to no virtual function but make_help.
    mutable bool shows_all_ = false;
    mutable std::string command_;
};

std::string without_environment(std::string text) {
    const size_t place = text.find(" (Env:");
    return place == std::string::npos ? text : text.substr(0, place);
}

}  // namespace

void set_up_help(CLI::App& app) {
    const auto formatter = std::make_shared<HelpFormatter>();
    formatter->column_width(26);
    app.formatter(formatter);
    for (CLI::App* command : app.get_subcommands({})) {
        command->formatter(formatter);
        command->footer("");
        for (CLI::Option* option : command->get_options()) {
            const auto is_it = [&](std::string_view name) { return option->check_name(std::string(name)); };
            if (std::any_of(seldom_needed.begin(), seldom_needed.end(), is_it)) option->group(seldom);
        }
        command->set_help_all_flag("--help-all", "All options");
    }
}

std::string argument_of(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return "";
    const std::string text =
        without_environment(option.get_option_text().empty() ? option.get_type_name() : option.get_option_text());
    return text.substr(0, text.find(":{"));
}

std::vector<std::string> choices_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    if (const size_t open = type.find(":{"); open != std::string::npos)
        return CLI::detail::split(type.substr(open + 2, type.find('}', open) - open - 2), ',');
    const std::string argument = argument_of(option);
    if (argument.find('|') == std::string::npos || argument.find('[') != std::string::npos) return {};
    return CLI::detail::split(argument, '|');
}

}  // namespace surimi
