// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "baker/cli/commands.h"
#include "baker/cli/existing_uv.h"
#include "baker/cli/fix_options.h"
#include "baker/cli/options.h"
#include "baker/cli/plan_report.h"
#include "baker/cli/progress.h"
#include "baker/cli/time_budget.h"

namespace surimi {
namespace {

/// Two different bakes differ in what they cost.
void warn_of_other_settings(const std::string& settings, const BakeTruth& truth) {
    if (nlohmann::json::parse(settings) != nlohmann::json::parse(truth.settings_json))
        fmt::print(stderr, "warning: the bake had other settings than this plan: {} in place of {}\n",
                   truth.settings_json, settings);
}

int plan_scene(const Given& given, const std::filesystem::path& manifest) {
    Config config = effective_config(given);
    if (given.print_config) {
        fmt::print("{}", to_toml(config));
        return 0;
    }
    set_thread_count(config.threads);
    std::optional<BakeTruth> truth;
    if (!manifest.empty()) truth = read_truth(manifest);  // before seconds of work
    const Scene scene = load_scene(given, config);
    const Progress progress = make_progress(given.progress, given.quiet);
    Plan result;
    with_picture_of_faults(scene, config.bake.unwrap, ".", [&] {
        if (config.seconds > 0) {
            const std::string choice = spend(scene, config, progress);
            if (!given.quiet) fmt::print(stderr, "{}", choice);
        }
        result = plan(scene, config.bake, progress);
    });
    const std::string settings = settings_json(config);
    std::optional<Comparison> comparison;
    if (truth) {
        comparison = compare(result, *truth);
        warn_of_other_settings(settings, *truth);
    }
    const Comparison* compared = comparison ? &*comparison : nullptr;
    fmt::print("{}", given.json ? plan_json(scene, result, settings, compared)
                                : plan_text(scene, result, config.bake, compared));
    if (!given.quiet)
        for (const std::string& warning : result.warnings) fmt::print(stderr, "warning: {}\n", warning);
    return 0;
}

}  // namespace

Run add_plan_command(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    const auto manifest = std::make_shared<std::filesystem::path>();
    CLI::App* command = app.add_subcommand(
        "plan", "What a bake would do and cost, and why: which monitor reaches what, stages, seconds, rays, memory");
    add_scene_options(*command, *given);
    add_unwrap_options(*command, *given);
    add_gather_options(*command, given->gather.emplace());
    add_fix_options(*command, given->without);
    command->add_option("--compare", *manifest, "NAME.visibility.json of a bake: what was foretold beside what was")
        ->type_name("MANIFEST");
    return [given, manifest] { return plan_scene(*given, *manifest); };
}

}  // namespace surimi
