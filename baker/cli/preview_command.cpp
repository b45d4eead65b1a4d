// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "baker/cli/commands.h"
#include "baker/cli/light_options.h"
#include "baker/cli/numbers.h"
#include "baker/cli/options.h"
#include "baker/cli/picture_file.h"
#include "baker/cli/preview_report.h"
#include "baker/cli/progress.h"
#include "baker/cli/window_options.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/preview/display.h"
#include "runtime/scene/gltf.h"
#include "runtime/visibility/baked.h"

namespace surimi {
namespace {

const std::map<std::string, Show> shows = {{"lit", Show::lit},
                                           {"diffuse", Show::diffuse},
                                           {"specular", Show::specular},
                                           {"visibility", Show::visibility},
                                           {"unshadowed", Show::unshadowed},
                                           {"shadowed", Show::shadowed},
                                           {"uv", Show::uv},
                                           {"texels", Show::texels},
                                           {"normals", Show::normals},
                                           {"roughness", Show::roughness}};

/// The names of a table of choices, as CLI11 checks them and as the help lists them.
template <class T>
std::vector<std::string> names_of(const std::map<std::string, T>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) names.push_back(name);
    return names;
}

struct PreviewOptions {
    Given given;
    std::filesystem::path out;
    std::vector<std::filesystem::path> maps;
    std::vector<std::string> camera;
    std::vector<double> look_at;
    double yfov_degrees = 0;
    std::optional<double> exposure;
    std::string show = "lit";
    std::vector<int> size{1280, 720};
    int samples = 3;
    std::vector<std::string> lights;
    std::vector<std::string> pictures;
    std::string visibility = "baked";
    std::string model = "exact";
    int light_samples = 16;
    int reference_samples = 64;
    bool progressive = false;
    bool compare = false;
    bool explain = false;
    std::optional<double> roughness;
    WindowOptions window;
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

/// The maps of a bake by page, from the files given or from the scene; none for an unbaked scene.
std::vector<VisibilityMap> load_pages(const Scene& scene, const PreviewOptions& options) {
    if (options.maps.empty()) {
        std::vector<VisibilityMap> pages = carried_pages(scene);
        if (pages.empty() && !options.given.quiet)
            fmt::print(
                stderr,
                "note: {} carries no visibility map, so nothing is shadowed; bake it, or give a map with --map\n",
                scene.path.filename().string());
        return pages;
    }
    const size_t count = page_count(scene);
    if (options.maps.size() != count)
        throw Error(ErrorKind::usage, fmt::format("{} was baked into {} maps, not {}; give all of them to --map",
                                                  scene.path.filename().string(), count, options.maps.size()));
    std::vector<VisibilityMap> pages;
    for (const auto& file : options.maps) pages.push_back(read_map_exr(file));
    return pages;
}

const Camera& camera_named(const Scene& scene, const std::string& name) {
    for (const Camera& camera : scene.cameras)
        if (camera.name == name) return camera;
    std::string names;
    for (const Camera& camera : scene.cameras) names += " " + camera.name;
    throw Error(ErrorKind::usage,
                fmt::format("no camera is called \"{}\"; the scene has{}", name, names.empty() ? " none" : names));
}

View choose_view(const Lighting& lighting, const PreviewOptions& options) {
    const Scene& scene = lighting.scene;
    const double aspect = static_cast<double>(options.size[0]) / options.size[1];
    const bool has_target = !options.look_at.empty();
    View view;
    if (options.camera.size() == 1 && options.camera[0] != "auto") {
        view = view_of(camera_named(scene, options.camera[0]));
    } else if (options.camera.empty() && !scene.cameras.empty()) {
        view = view_of(scene.cameras.front());
    } else {
        view = frame_automatically(lighting, aspect);
    }
    if (options.camera.size() == 3)
        for (int i = 0; i < 3; ++i) view.eye[i] = parse_number(options.camera[static_cast<size_t>(i)], "--camera");
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

double exposure_of(const PreviewOptions& options, const Picture& picture) {
    return options.exposure ? std::exp2(*options.exposure) : automatic_exposure(picture);
}

LightingSettings lighting_settings(const PreviewOptions& options) {
    LightingSettings settings;
    settings.samples = options.light_samples;
    settings.roughness = options.roughness;
    if (options.visibility == "none") settings.visibility = VisibilitySource::none;
    if (options.visibility == "stochastic") settings.visibility = VisibilitySource::stochastic;
    if (options.model == "kanikama") settings.model = ShadingModel::kanikama;
    if (options.model == "three") settings.model = ShadingModel::three;
    if (options.visibility == "reference" || options.model == "reference") settings.model = ShadingModel::reference;
    return settings;
}

/// Writes the passes whose number is a power of two, so that a viewer that reloads the file shows the picture grow.
auto writer_of_passes(const PreviewOptions& options, Show show) {
    return [&options, show](const Picture& picture, int pass, int) {
        if (options.progressive && (pass & (pass - 1)) == 0)
            write_picture(options.out, picture.pixels, show, exposure_of(options, picture));
    };
}

/// OUT.png -> OUT.reference.png
std::filesystem::path beside(const std::filesystem::path& out, const std::string& what) {
    return std::filesystem::path(out).replace_extension("." + what + out.extension().string());
}

/// Renders the reference, writes it and the heat map of the difference, and prints the numbers.
void compare_with_reference(const Lighting& lighting, const View& view, RenderSettings settings,
                            const PreviewOptions& options, const Picture& picture, double exposure) {
    LightingSettings truth = lighting.settings;
    truth.model = ShadingModel::reference;
    truth.samples = std::max(1, options.reference_samples / 2);
    const Lighting by_brute_force(lighting.scene, lighting.pages, lighting.rays, lighting.lights, truth);
    std::vector<Image<Vec3f>> halves;
    for (const uint64_t seed : {1, 2}) {
        settings.seed = seed;
        const Progress progress = make_progress(options.given.progress, options.given.quiet);
        halves.push_back(render(by_brute_force, view, settings, progress).pixels);
    }
    const Comparison comparison = compare_pictures(picture, halves, exposure);
    write_picture(beside(options.out, "reference"), comparison.reference, settings.show, exposure);
    const double brightest = 0.1 / exposure;  // of the heat map, nits: a seventh of what bright surfaces have
    const Image<float> error = absolute_difference(picture.pixels, comparison.reference);
    write_file(std::filesystem::path(options.out).replace_extension(".difference.png"),
               encode_png(heat_map(error, 0, brightest)));
    fmt::print("{}\n", options.given.json ? as_json(comparison) : as_text(comparison));
}

void report(const PreviewOptions& options, const View& view, const Picture& picture, double exposure) {
    const double stops = std::log2(exposure);
    if (options.given.json && !options.compare) {
        const auto json = [](const Vec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
        const nlohmann::ordered_json report{{"file", options.out.string()},
                                            {"eye", json(view.eye)},
                                            {"forward", json(view.forward)},
                                            {"exposure", stops}};
        fmt::print("{}\n", report.dump(2));
    }
    if (options.given.json) return;
    if (!options.given.quiet)
        fmt::print(stderr, "camera ({:.3f}, {:.3f}, {:.3f}) towards ({:.3f}, {:.3f}, {:.3f}), exposure {:+.2f} EV\n",
                   view.eye.x, view.eye.y, view.eye.z, view.forward.x, view.forward.y, view.forward.z, stops);
    if (!options.given.quiet && options.show == "lit" && picture.lit_share < 0.1)
        fmt::print(stderr,
                   "note: only {:.2g} % of the picture shows lit surface; --camera auto looks for a better view\n",
                   100 * picture.lit_share);
    fmt::print("{}\n", options.out.string());
}

/// Throws Error(usage) for options that do not go together.
void check(const PreviewOptions& options) {
    check(options.window);
    const auto refuse = [](const std::string& what) { throw Error(ErrorKind::usage, what); };
    if (options.camera.size() == 2) refuse("--camera takes a name or three numbers");
    const std::string extension = options.out.extension().string();
    if (options.out.empty() && !options.window.is_wanted) refuse("preview needs -o FILE, or --window");
    if (!options.out.empty() && extension != ".png" && extension != ".exr")
        refuse(options.out.string() + ": the picture must be a .png or .exr");
    if (options.compare && options.show != "lit") refuse("--compare is for --show lit");
    if (options.window.is_wanted && (options.compare || options.explain || options.progressive))
        refuse("--compare, --explain and --progressive are for a file, not for --window");
}

void show_in_window(Lighting lighting, const View& view, const PreviewOptions& options) {
    Choices choices = choices_for(lighting, view);
    choices.show = shows.at(options.show);
    choices.samples_per_side = options.samples;
    choices.exposure = options.exposure;
    WindowSettings settings;
    settings.width = options.size[0];
    settings.height = options.size[1];
    show_window(std::move(lighting), choices, settings, options.out, options.window);
}

int preview(const PreviewOptions& options) {
    check(options);
    const Config config = effective_config(options.given);
    set_thread_count(config.threads);
    Scene scene = read_gltf(options.given.scene);
    apply_roles(scene, config.roles);
    find_monitors(scene, monitor_request(scene, config));
    if (!options.given.quiet) print_notes(scene);
    const std::vector<VisibilityMap> pages = load_pages(scene, options);
    const RayScene rays(scene, Attach::everything);
    Lighting lighting(scene, pages, rays, chosen_lights(scene, options.lights, options.pictures),
                      lighting_settings(options));
    const View view = choose_view(lighting, options);
    if (options.window.is_wanted) {
        show_in_window(std::move(lighting), view, options);
        return 0;
    }
    RenderSettings settings;
    settings.width = options.size[0];
    settings.height = options.size[1];
    settings.samples_per_side = options.samples;
    settings.show = shows.at(options.show);
    const Picture picture = render(lighting, view, settings, make_progress(options.given.progress, options.given.quiet),
                                   writer_of_passes(options, settings.show));
    const double exposure = exposure_of(options, picture);
    write_picture(options.out, picture.pixels, settings.show, exposure);
    if (options.explain) fmt::print("{}\n", explanation(lighting, picture));
    if (options.compare) compare_with_reference(lighting, view, settings, options, picture, exposure);
    report(options, view, picture, exposure);
    return 0;
}

void add_light_options(CLI::App& command, PreviewOptions& options) {
    command.add_option("--light", options.lights, "Radiance of a monitor, linear, nits; repeatable; needs no new bake")
        ->type_name("NODE=R,G,B")
        ->expected(1)
        ->take_all();
    command.add_option("--picture", options.pictures, "Image that a monitor shows; repeatable")
        ->type_name("NODE=FILE")
        ->expected(1)
        ->take_all();
    command
        .add_option("--visibility", options.visibility,
                    "Shadows: none, baked (the map), stochastic (ratio of a few rays), reference (all of the light by "
                    "brute force) [baked]")
        ->type_name("SOURCE")
        ->check(CLI::IsMember({"none", "baked", "stochastic", "reference"}));
    command
        .add_option("--model", options.model,
                    "exact, kanikama or three (what their shaders show), or reference (brute force) [exact]")
        ->type_name("MODEL")
        ->check(CLI::IsMember({"exact", "kanikama", "three", "reference"}));
    command
        .add_option("--light-samples", options.light_samples,
                    "Rays of each sample of a pixel to each monitor, where light is sampled, 1 to 65536 [16]")
        ->type_name("N")
        ->check(CLI::Range(1, 65536));
    command.add_option("--roughness", options.roughness, "Of every surface, 0 to 1, in place of its own")
        ->type_name("R")
        ->check(CLI::Range(0.0, 1.0));
    command.add_flag("--progressive", options.progressive, "Write the picture after passes 1, 2, 4, ... as well");
    command.add_flag("--explain", options.explain, "Say what the scene calls for, what was computed and what not");
    command.add_flag("--compare", options.compare,
                     "Also render by brute force: FILE.reference, FILE.difference, and the errors by roughness");
    command
        .add_option("--reference-samples", options.reference_samples,
                    "Light samples of the reference of --compare, 2 to 65536 [64]")
        ->type_name("N")
        ->check(CLI::Range(2, 65536));
}

}  // namespace

Run add_preview_command(CLI::App& app) {
    const auto options = std::make_shared<PreviewOptions>();
    CLI::App* command = app.add_subcommand("preview", "A picture of a baked scene, lit by its monitors");
    add_scene_options(*command, options->given);
    command
        ->add_option("-o,--output", options->out,
                     "Picture to write: .png (filmic, sRGB) or .exr (linear); with --window, what its buttons save")
        ->type_name("FILE");
    command
        ->add_option("--map", options->maps,
                     "The map as EXR, in place of the one that SCENE carries; repeatable, in order, if it has several")
        ->type_name("FILE")
        ->allow_extra_args(false);
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
    command
        ->add_option("--show", options->show,
                     "lit, diffuse, specular, visibility, unshadowed, shadowed, uv, texels, normals or roughness [lit]")
        ->type_name("WHAT")
        ->check(CLI::IsMember(names_of(shows)));
    add_light_options(*command, *options);
    add_window_options(*command, options->window);
    return [options] { return preview(*options); };
}

}  // namespace surimi
