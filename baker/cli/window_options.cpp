// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/window_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "baker/cli/picture_file.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"

namespace surimi {
namespace {

/// The name to save under: the one given, else the first of the scene's numbered ones that is free.
std::filesystem::path name_to_save(const std::filesystem::path& out, const std::filesystem::path& scene,
                                   const std::string& extension) {
    if (!out.empty()) return std::filesystem::path(out).replace_extension(extension);
    for (int number = 1;; ++number)
        if (const std::filesystem::path path = fmt::format("{}.preview-{}{}", scene.stem().string(), number, extension);
            !std::filesystem::exists(path))
            return path;
}

}  // namespace

void add_window_options(CLI::App& command, WindowOptions& options) {
    command.add_flag("--window", options.is_wanted,
                     "Walk in the scene and change its light, in a window; H there lists keys");
    command
        .add_option("--screenshot", options.screenshot,
                    "With --window: save what it shows, controls and all, once the picture is finished, and close it")
        ->type_name("FILE.png");
    command
        .add_option("--frames", options.frames,
                    "With --screenshot: do not wait for more than N frames of the window, finished or not")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
}

void check(const WindowOptions& options) {
    if (!options.screenshot.empty() && (!options.is_wanted || options.screenshot.extension() != ".png"))
        throw Error(ErrorKind::usage, "--screenshot takes a .png, and goes with --window");
    if (options.frames > 0 && options.screenshot.empty())
        throw Error(ErrorKind::usage, "--frames goes with --screenshot");
}

void show_window(Lighting lighting, const Choices& choices, WindowSettings settings, const std::filesystem::path& out,
                 const WindowOptions& options) {
    const std::filesystem::path& scene = lighting.scene.path;
    settings.title = scene.filename().string();
    settings.views.push_back({"first view", choices.view});
    for (const Camera& camera : lighting.scene.cameras) settings.views.push_back({camera.name, view_of(camera)});
    if (lighting.pages.empty()) settings.note = "This scene carries no visibility map: nothing to show of one.";
    settings.save = [&](const Frame& frame, const std::string& extension) {
        const std::filesystem::path path = name_to_save(out, scene, extension);
        write_picture(path, frame.pixels, frame.show, frame.status.exposure);
        return path.string();
    };
    if (!options.screenshot.empty())
        settings.screenshot = [&](const Image<glm::u8vec3>& pixels) {
            write_file(options.screenshot, encode_png(pixels));
            fmt::print("{}\n", options.screenshot.string());
        };
    settings.most_frames = options.frames;
    open_window(std::move(lighting), choices, settings);
}

}  // namespace surimi
