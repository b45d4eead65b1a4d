// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <fstream>
#include <iterator>
#include <memory>

#include "baker/cli/commands.h"
#include "baker/cli/density_summary.h"
#include "baker/cli/evidence_summary.h"
#include "baker/cli/existing_uv.h"
#include "baker/cli/export_options.h"
#include "baker/cli/fix_options.h"
#include "baker/cli/options.h"
#include "baker/cli/progress.h"
#include "baker/cli/time_budget.h"
#include "baker/memory.h"
#include "baker/report/report.h"
#include "baker/write/output.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// What a person wants to know when it is done.
void print_summary(const Scene& scene, const Bake& bake) {
    double seconds = 0;
    size_t rays = 0;
    for (const StageCost& cost : bake.costs) seconds += cost.seconds, rays += cost.rays;
    if (bake.pages.size() > 1) fmt::print(stderr, "{} maps, each ", bake.pages.size());
    fmt::print(stderr, "{} x {} texels, {} charts at {:.4g} texels per metre; {:.1f} s, {:.1f} M rays, {:.0f} MiB\n",
               bake.atlas.width, bake.atlas.height, bake.atlas.charts.size(), bake.atlas.texels_per_metre, seconds,
               static_cast<double>(rays) / 1e6, static_cast<double>(bake.costs.back().peak_bytes) / 1048576);
    print_evidence(scene, bake);
    print_uv_choice(bake.atlas);
    print_density_weights(bake.atlas);
    for (const std::string& warning : bake.warnings) fmt::print(stderr, "warning: {}\n", warning);
}

struct BakeOptions {
    Given given;
    std::filesystem::path out = "out";
    std::vector<std::string> exports;
    bool no_report = false;
};

/// Writes the report unless the user wants none, or bounds the memory, which reading a large bake back would exceed.
void add_report(const BakeOptions& options, const Config& config, const OutputPaths& paths,
                std::vector<std::filesystem::path>& written) {
    if (options.no_report) return;
    if (config.bake.memory == 0) {
        written.push_back(write_report({paths.manifest_json, {}, {}, {}}));
    } else if (!options.given.quiet) {
        fmt::print(stderr, "note: no report, since --memory bounds the bake; surimi report {} writes one\n",
                   options.out.string());
    }
}

int bake_scene(const BakeOptions& options) {
    const Given& given = options.given;
    const std::filesystem::path& out = options.out;
    Config config = effective_config(given);
    const std::vector<std::string> targets = parse_export_targets(options.exports, "--export");
    if (given.print_config) {
        fmt::print("{}", to_toml(config));
        return 0;
    }
    set_thread_count(config.threads);
    return_large_memory();
    const Scene scene = load_scene(given, config);
    Bake result;
    with_picture_of_faults(scene, config.bake.unwrap, out, [&] {
        const Progress progress = make_progress(given.progress, given.quiet);
        if (config.seconds > 0) {
            const std::string choice = spend(scene, config, progress);
            if (!given.quiet) fmt::print(stderr, "{}", choice);
        }
        result = bake(scene, config.bake, progress);
    });
    const OutputPaths paths = write_bake(out, scene, result, settings_json(config));
    std::vector<std::filesystem::path> written = paths.all();
    for (const auto& path : export_from(paths.manifest_json, targets, given.quiet)) written.push_back(path);
    add_report(options, config, paths, written);
    if (!given.quiet) print_summary(scene, result);
    if (given.json) {
        std::ifstream manifest(paths.manifest_json);
        fmt::print("{}", std::string(std::istreambuf_iterator<char>(manifest), {}));
    } else {
        for (const auto& path : written) fmt::print("{}\n", path.string());
    }
    if (config.is_strict) require_promises(scene, result);
    return 0;
}

}  // namespace

Run add_bake_command(CLI::App& app) {
    const auto options = std::make_shared<BakeOptions>();
    CLI::App* command = app.add_subcommand("bake", "Bake the visibility map of a scene's monitors");
    add_scene_options(*command, options->given);
    add_unwrap_options(*command, options->given);
    add_gather_options(*command, options->given.gather.emplace());
    add_fix_options(*command, options->given.without);
    add_export_option(*command, options->exports);
    command->add_flag("--no-report", options->no_report, "Write no NAME.report.html; --memory implies it");
    command->add_option("-o,--output", options->out, "Folder to write to [out]")->type_name("FOLDER");
    return [options] { return bake_scene(*options); };
}

}  // namespace surimi
