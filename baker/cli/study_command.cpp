// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <span>
#include <string>

#include "baker/cli/commands.h"
#include "baker/cli/options.h"
#include "baker/cli/progress.h"
#include "baker/study/plot.h"
#include "baker/study/reading.h"
#include "baker/study/study.h"
#include "baker/study/table.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

struct StudyOptions {
    std::filesystem::path out = "study";
    long long texels = 500;
    long long reference = 65536;
};

StudySettings settings_of(const StudyOptions& options, const Config& config) {
    if (options.texels < 1 || options.texels > 100'000)
        throw Error(ErrorKind::usage, "--texels must be from 1 to 100000");
    if (options.reference < 64 || options.reference > 1 << 24)
        throw Error(ErrorKind::usage, "--reference must be from 64 to 16777216 rays");
    StudySettings settings;
    settings.unwrap = config.bake.unwrap;
    settings.texels = static_cast<size_t>(options.texels);
    settings.reference_rays = static_cast<size_t>(options.reference);
    settings.seed = config.bake.gather.seed;
    return settings;
}

/// What each line of the plot is, as a list.
std::string key_of(const Study& result) {
    std::string text;
    for (const Series& series : result.series) text += fmt::format("- **{}**: {}.\n", series.label, series.notes);
    return text;
}

int study_scene(const Given& given, const StudyOptions& options) {
    const Config config = effective_config(given);
    if (given.print_config) {
        fmt::print("{}", to_toml(config));
        return 0;
    }
    const StudySettings settings = settings_of(options, config);
    set_thread_count(config.threads);
    const Scene scene = load_scene(given, config);
    make_folder(options.out);  // before minutes of work
    const Study result = study(scene, settings, make_progress(given.progress, given.quiet));

    const std::string name = scene.path.stem().string(), file = scene.path.filename().string();
    const std::string words = reading(result, file);
    const auto picture = options.out / (name + ".study.svg"), table = options.out / (name + ".study.csv"),
               numbers = options.out / (name + ".study.json"), text = options.out / (name + ".study.md");
    PendingFiles pending;
    const auto write = [&](const std::filesystem::path& path, const std::string& content) {
        write_bytes(pending.add(path), std::span(reinterpret_cast<const uint8_t*>(content.data()), content.size()));
    };
    write(picture, to_svg(result, name));
    write(table, to_csv(result));
    write(numbers, to_json(result, file));
    write(text, fmt::format("# {}: what accuracy costs\n\n{}\n![{}]({})\n\n{}", name, words, name,
                            picture.filename().string(), key_of(result)));
    pending.commit();

    if (given.json) {
        fmt::print("{}", to_json(result, file));
        return 0;
    }
    fmt::print("{}", words);
    for (const auto& path : {picture, table, numbers, text}) fmt::print("{}\n", path.string());
    return 0;
}

}  // namespace

Run add_study_command(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    const auto options = std::make_shared<StudyOptions>();
    CLI::App* command =
        app.add_subcommand("study", "What accuracy costs in time on this scene, as a plot and in words");
    add_scene_options(*command, *given);
    add_unwrap_options(*command, *given);
    command->add_option("--seed", given->gather.emplace().seed, "Seed of the random numbers [0]")
        ->option_text("N (Env:SURIMI_SEED)");
    command->add_option("--texels", options->texels, "Lit texels to measure, over all monitors, 1 to 100000 [500]")
        ->type_name("N");
    command->add_option("--reference", options->reference, "Rays of the reference for each, 64 to 16777216 [65536]")
        ->type_name("N");
    command->add_option("-o,--output", options->out, "Folder to write to [study]")->type_name("FOLDER");
    return [given, options] { return study_scene(*given, *options); };
}

}  // namespace surimi
