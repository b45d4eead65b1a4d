// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>

#include "baker/cli/commands.h"
#include "baker/cli/density_summary.h"
#include "baker/cli/options.h"
#include "baker/cli/progress.h"
#include "baker/write/baked_glb.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"

namespace surimi {
namespace {

/// An unwrap needs no monitor; where there are some, they decide where texels go.
void find_monitors_if_any(Scene& scene, const Given& given, const Config& config) {
    try {
        find_monitors(scene, config.monitors);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::nothing_to_bake) throw;
        if (!given.quiet) fmt::print(stderr, "note: unwrapped without monitors: {}\n", error.what());
    }
}

int unwrap_scene(const Given& given, const std::filesystem::path& out) {
    const Config config = effective_config(given);
    if (given.print_config) {
        fmt::print("{}", to_toml(config));
        return 0;
    }
    set_thread_count(config.threads);
    Scene scene = read_gltf(given.scene);
    find_monitors_if_any(scene, given, config);
    if (!given.quiet) print_notes(scene);
    const Atlas atlas = unwrap(scene, config.bake.unwrap, make_progress(given.progress, given.quiet));
    std::error_code ignored;
    if (std::filesystem::equivalent(out, given.scene, ignored))
        throw Error(ErrorKind::usage, out.string() + ": is the input; choose another file with -o");
    write_file(out, make_baked_glb(scene, atlas, {}));
    if (given.json) {
        nlohmann::ordered_json json{{"file", out.string()},          {"width", atlas.width},
                                    {"height", atlas.height},        {"pages", atlas.pages},
                                    {"charts", atlas.charts.size()}, {"texels_per_metre", atlas.texels_per_metre}};
        fmt::print("{}\n", json.dump(2));
    } else {
        fmt::print("{}\n", out.string());
    }
    if (!given.quiet) print_density_weights(atlas);
    if (!given.quiet)
        fmt::print(stderr, "{} charts at {:.4g} texels per metre on {}{} x {}\n", atlas.charts.size(),
                   atlas.texels_per_metre, atlas.pages > 1 ? fmt::format("{} maps of ", atlas.pages) : "", atlas.width,
                   atlas.height);
    return 0;
}

}  // namespace

Run add_unwrap_command(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    const auto out = std::make_shared<std::filesystem::path>();
    CLI::App* command = app.add_subcommand("unwrap", "Cut a scene into lightmap charts: the scene plus TEXCOORD_1");
    add_scene_options(*command, *given);
    add_unwrap_options(*command, *given);
    command->add_option("-o,--output", *out, "The .glb to write; default: SCENE's name with .unwrapped.glb")
        ->type_name("FILE");
    return [given, out] {
        if (out->empty()) *out = given->scene.stem().string() + ".unwrapped.glb";
        return unwrap_scene(*given, *out);
    };
}

}  // namespace surimi
