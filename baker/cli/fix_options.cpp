// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/fix_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <sstream>

namespace surimi {

void add_fix_options(CLI::App& app, std::vector<std::string>& without) {
    std::string what = "Turn a fix off; repeatable.";
    for (const Fix& fix : fixes()) what += fmt::format(" {}: {};", fix.name, fix.what);
    what.back() = '.';
    app.add_option("--without", without, what)
        ->option_text("FIX (Env:SURIMI_WITHOUT)")
        ->delimiter(',')
        ->expected(1)
        ->take_all();
}

std::vector<std::string> environment_without() {
    std::vector<std::string> names;
    const char* text = std::getenv("SURIMI_WITHOUT");
    std::istringstream stream(text ? text : "");
    for (std::string name; std::getline(stream, name, ',');)
        if (!name.empty()) names.push_back(name);
    return names;
}

void do_without(const std::vector<std::string>& names, const std::string& source, BakeSettings& settings) {
    for (const Fix& fix : fixes()) fix.in(settings) = true;
    for (const std::string& name : names) fix_named(name, source).in(settings) = false;
}

std::vector<std::string> without(const BakeSettings& settings) {
    std::vector<std::string> names;
    BakeSettings copy = settings;
    for (const Fix& fix : fixes())
        if (!fix.in(copy)) names.emplace_back(fix.name);
    return names;
}

std::string fixes_toml(const BakeSettings& settings) {
    std::string list, all;
    for (const std::string& name : without(settings)) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
    for (const Fix& fix : fixes()) all += fmt::format("{}{}", all.empty() ? "" : ", ", fix.name);
    return fmt::format("without = [{}]           # fixes to do without: {}\n", list, all);
}

}  // namespace surimi
