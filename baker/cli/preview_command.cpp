// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "baker/cli/commands.h"
#include "baker/cli/options.h"
#include "baker/cli/progress.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/preview/render.h"
#include "runtime/scene/gltf.h"

namespace surimi {
namespace {

const std::map<std::string, Show> shows = {{"lit", Show::lit},
                                           {"visibility", Show::visibility},
                                           {"unshadowed", Show::unshadowed},
                                           {"shadowed", Show::shadowed},
                                           {"uv", Show::uv},
                                           {"texels", Show::texels},
                                           {"normals", Show::normals}};

struct PreviewOptions {
    Given given;
    std::filesystem::path out;
    std::filesystem::path map;
    std::vector<std::string> camera;
    std::vector<double> look_at;
    double yfov_degrees = 0;
    std::optional<double> exposure;
    std::string show = "lit";
    std::vector<int> size{1280, 720};
    int samples = 3;
};

/// The material that carries a map; none: an unbaked scene.
const Material* carrier(const Scene& scene) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [](const Material& m) { return m.visibility_map.image >= 0; });
    return found == scene.materials.end() ? nullptr : &*found;
}

/// The monitors that the map names, unless the user names others.
MonitorRequest monitor_request(const Scene& scene, const Config& config) {
    MonitorRequest request = config.monitors;
    if (!request.command_line.empty()) return request;
    if (const Material* material = carrier(scene))
        for (int c = 0; c < 3; ++c)
            if (const std::string& name = material->visibility_channels[static_cast<size_t>(c)]; !name.empty())
                request.command_line.push_back({name, c});
    return request;
}

VisibilityMap load_map(const Scene& scene, const PreviewOptions& options) {
    if (!options.map.empty()) return read_map_exr(options.map);
    const Material* material = carrier(scene);
    if (material) {
        const auto& image = scene.images[static_cast<size_t>(material->visibility_map.image)];
        if (image.empty())
            throw Error(ErrorKind::scene,
                        scene.path.string() + ": its visibility map could not be decoded; give one with --map");
        return map_from_image(image, material->visibility_is_srgb);
    }
    if (!options.given.quiet)
        fmt::print(stderr,
                   "note: {} carries no visibility map, so nothing is shadowed; bake it, or give a map with --map\n",
                   scene.path.filename().string());
    return {};
}

double parse_number(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw Error(ErrorKind::usage, "--camera takes the name of a camera or three numbers, not \"" + text + "\"");
    return value;
}

const Camera& camera_named(const Scene& scene, const std::string& name) {
    for (const Camera& camera : scene.cameras)
        if (camera.name == name) return camera;
    std::string names;
    for (const Camera& camera : scene.cameras) names += " " + camera.name;
    throw Error(ErrorKind::usage,
                fmt::format("no camera is called \"{}\"; the scene has{}", name, names.empty() ? " none" : names));
}

View choose_view(const Scene& scene, const VisibilityMap& map, const RayScene& rays, const PreviewOptions& options) {
    const double aspect = static_cast<double>(options.size[0]) / options.size[1];
    const bool has_target = !options.look_at.empty();
    View view;
    if (options.camera.size() == 1 && options.camera[0] != "auto") {
        view = view_of(camera_named(scene, options.camera[0]));
    } else if (options.camera.empty() && !scene.cameras.empty()) {
        view = view_of(scene.cameras.front());
    } else {
        view = frame_automatically(scene, map, rays, aspect);
    }
    if (options.camera.size() == 3)
        for (int i = 0; i < 3; ++i) view.eye[i] = parse_number(options.camera[static_cast<size_t>(i)]);
    const double yfov = options.yfov_degrees > 0 ? options.yfov_degrees * pi / 180 : view.yfov;
    if (has_target) {
        view = look_at(view.eye, {options.look_at[0], options.look_at[1], options.look_at[2]}, yfov);
    } else if (options.camera.size() == 3) {
        const Bounds box = bounds(scene);
        view = look_at(view.eye, 0.5 * (box.low + box.high), yfov);
    }
    view.yfov = yfov;
    return view;
}

void write_picture(const std::filesystem::path& path, const Picture& picture, Show show, double exposure) {
    if (path.extension() == ".exr") {
        Channels channels{picture.pixels.width, picture.pixels.height, {"R", "G", "B"}, {}};
        for (const Vec3f& p : picture.pixels.pixels) channels.values.insert(channels.values.end(), {p.x, p.y, p.z});
        PendingFiles pending;
        write_exr(pending.add(path), channels, ExrDepth::half);
        pending.commit();
    } else {
        write_file(path, encode_png(to_display(picture, show, exposure)));
    }
}

int preview(const PreviewOptions& options) {
    const Config config = effective_config(options.given);
    set_thread_count(config.threads);
    if (options.out.extension() != ".png" && options.out.extension() != ".exr")
        throw Error(ErrorKind::usage, options.out.string() + ": the picture must be a .png or .exr");
    Scene scene = read_gltf(options.given.scene);
    find_monitors(scene, monitor_request(scene, config));
    if (!options.given.quiet) print_notes(scene);
    const VisibilityMap map = load_map(scene, options);
    const RayScene rays(scene);
    const View view = choose_view(scene, map, rays, options);
    RenderSettings settings;
    settings.width = options.size[0];
    settings.height = options.size[1];
    settings.samples_per_side = options.samples;
    settings.show = shows.at(options.show);
    const Picture picture =
        render(scene, map, rays, view, settings, make_progress(options.given.progress, options.given.quiet));
    const double exposure = options.exposure ? std::exp2(*options.exposure) : automatic_exposure(picture);
    write_picture(options.out, picture, settings.show, exposure);
    const double stops = std::log2(exposure);
    if (options.given.json) {
        const auto json = [](const Vec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
        const nlohmann::ordered_json report{{"file", options.out.string()},
                                            {"eye", json(view.eye)},
                                            {"forward", json(view.forward)},
                                            {"exposure", stops}};
        fmt::print("{}\n", report.dump(2));
        return 0;
    }
    if (!options.given.quiet)
        fmt::print(stderr, "camera ({:.3f}, {:.3f}, {:.3f}) towards ({:.3f}, {:.3f}, {:.3f}), exposure {:+.2f} EV\n",
                   view.eye.x, view.eye.y, view.eye.z, view.forward.x, view.forward.y, view.forward.z, stops);
    if (!options.given.quiet && settings.show == Show::lit && picture.lit_share < 0.1)
        fmt::print(stderr,
                   "note: only {:.2g} % of the picture shows lit surface; --camera auto looks for a better view\n",
                   100 * picture.lit_share);
    fmt::print("{}\n", options.out.string());
    return 0;
}

}  // namespace

Run add_preview_command(CLI::App& app) {
    const auto options = std::make_shared<PreviewOptions>();
    CLI::App* command = app.add_subcommand("preview", "A picture of a baked scene, lit by its monitors");
    add_scene_options(*command, options->given);
    command->add_option("-o,--output", options->out, "Picture to write: .png (filmic, sRGB) or .exr (linear)")
        ->required()
        ->type_name("FILE");
    command->add_option("--map", options->map, "The map as EXR, in place of the one that SCENE carries")
        ->type_name("FILE");
    command
        ->add_option("--camera", options->camera,
                     "A camera of the scene by name, a place, or auto [the first, else auto]")
        ->type_name("NAME | X Y Z | auto")
        ->expected(1, 3);
    command->add_option("--look-at", options->look_at, "Look towards this place")->type_name("X Y Z")->expected(3);
    command->add_option("--fov", options->yfov_degrees, "Vertical field of view in degrees, 1 to 170")
        ->type_name("DEGREES")
        ->check(CLI::Range(1.0, 170.0));
    command->add_option("--size", options->size, "Size of the picture in pixels, 1 to 16384 [1280 720]")
        ->type_name("W H")
        ->expected(2)
        ->check(CLI::Range(1, 16384));
    command->add_option("--samples", options->samples, "Squared, the samples of a pixel, 1 to 64 [3]")
        ->type_name("N")
        ->check(CLI::Range(1, 64));
    command->add_option("--exposure", options->exposure, "Exposure in stops [automatic]")->type_name("EV");
    command->add_option("--show", options->show, "lit, visibility, unshadowed, shadowed, uv, texels or normals [lit]")
        ->type_name("WHAT")
        ->check(CLI::IsMember({"lit", "visibility", "unshadowed", "shadowed", "uv", "texels", "normals"}));
    return [options] {
        if (options->camera.size() == 2) throw Error(ErrorKind::usage, "--camera takes a name or three numbers");
        return preview(*options);
    };
}

}  // namespace surimi
