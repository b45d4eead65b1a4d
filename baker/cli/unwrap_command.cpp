// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <memory>

#include "baker/cli/commands.h"
#include "baker/cli/density_summary.h"
#include "baker/cli/existing_uv.h"
#include "baker/cli/options.h"
#include "baker/cli/progress.h"
#include "baker/write/unwrap_output.h"
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

/// FILE.glb, else a folder.
bool is_glb_name(const std::filesystem::path& out) {
    std::error_code ignored;
    if (out.extension() == ".gltf")
        throw Error(ErrorKind::usage, out.string() + ": a .glb is written, not a .gltf; rename it, or give a folder");
    return out.extension() == ".glb" && !std::filesystem::is_directory(out, ignored);
}

void print_summary(const Unwrapped& unwrapped) {
    const Atlas& atlas = unwrapped.atlas;
    const UnwrapNumbers& n = unwrapped.numbers;
    print_uv_choice(atlas);
    print_density_weights(atlas);
    for (const std::string& warning : atlas.warnings) fmt::print(stderr, "warning: {}\n", warning);
    fmt::print(stderr, "{} charts at {:.4g} texels per metre on {}{} x {}; {:.1f} s\n", n.charts,
               atlas.texels_per_metre, atlas.pages > 1 ? fmt::format("{} maps of ", atlas.pages) : "", atlas.width,
               atlas.height, unwrapped.seconds);
    fmt::print(
        stderr,
        "density efficiency {:.3f}, symmetric Dirichlet energy {:.4g} (4: no distortion), smooth seams {:.3g} m\n",
        n.density_efficiency, n.symmetric_dirichlet, n.smooth_seam_length);
}

int unwrap_scene(const Given& given, const std::filesystem::path& out) {
    const bool is_file = is_glb_name(out);
    const Config config = effective_config(given);
    if (given.print_config) {
        fmt::print("{}", to_toml(config));
        return 0;
    }
    set_thread_count(config.threads);
    Scene scene = read_gltf(given.scene);
    apply_roles(scene, config.roles);
    find_monitors_if_any(scene, given, config);
    if (!given.quiet) print_notes(scene);
    const Progress progress = make_progress(given.progress, given.quiet);

    Unwrapped unwrapped;
    unwrapped.settings_json = unwrap_settings_json(config);
    const auto start = std::chrono::steady_clock::now();
    with_picture_of_faults(scene, config.bake.unwrap, is_file ? out.parent_path() : out,
                           [&] { unwrapped.atlas = unwrap(scene, config.bake.unwrap, progress); });
    unwrapped.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    unwrapped.numbers = measure(scene, unwrapped.atlas);
    const UnwrapOutput output =
        is_file ? write_unwrapped_glb(out, scene, unwrapped) : write_unwrap(out, scene, unwrapped, progress);
    if (!given.quiet) print_summary(unwrapped);
    if (given.json) fmt::print("{}", output.report);
    for (const auto& path : output.paths)
        if (!given.json) fmt::print("{}\n", path.string());
    return 0;
}

}  // namespace

Run add_unwrap_command(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    const auto out = std::make_shared<std::filesystem::path>("uv");
    CLI::App* command = app.add_subcommand("unwrap", "Cut a scene into lightmap charts: the scene plus TEXCOORD_1");
    add_scene_options(*command, *given);
    add_unwrap_options(*command, *given);
    command
        ->add_option("-o,--output", *out,
                     "FILE.glb, or a folder for the glb, pictures of charts, density and stretch, and the numbers [uv]")
        ->type_name("FILE.glb | FOLDER");
    return [given, out] { return unwrap_scene(*given, *out); };
}

}  // namespace surimi
