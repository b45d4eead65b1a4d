// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "baker/cli/colors.h"
#include "baker/cli/commands.h"
#include "baker/lightmaps/coverage.h"
#include "baker/lightmaps/lightmap_ratio.h"
#include "baker/write/file.h"
#include "runtime/base/color.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"

namespace surimi {
namespace {

using Path = std::filesystem::path;

struct RatioOptions {
    std::array<std::vector<Path>, 3> files;  ///< of R, G, B: shadowed, unshadowed; empty where unused
    Path mask, validity;
    std::string out = "out/ratio";
    LightmapRatioSettings settings;
    std::optional<double> limit;
    bool is_linear = false, as_kanikama = false, json = false, quiet = false;
};

constexpr std::array<const char*, 3> channel_names = {"red", "green", "blue"};

/// A monitor's place in the map, and its lightmaps.
struct Pairs {
    std::vector<size_t> channels;
    std::vector<LightPair> pairs;
};

template <class Pixel>
void check_size(const Path& path, const Image<Pixel>& image, const Path& first, const Image<float>& other) {
    if (image.width != other.width || image.height != other.height)
        throw Error(ErrorKind::usage,
                    fmt::format("{}: is {} x {}, but {} is {} x {}; a map needs lightmaps of one size and UV layout",
                                path.string(), image.width, image.height, first.string(), other.width, other.height));
}

Lightmap read_lightmap(const Path& path, const RatioOptions& options) {
    const Channels channels = read_channels(path);
    const Image<Vec3f> stored = stored_colors(path, channels, "");
    Lightmap lightmap;
    lightmap.code_step = channels.code_step;
    lightmap.relative_step = channels.relative_step;
    lightmap.is_srgb = !options.is_linear && !holds_linear_values(path);
    lightmap.light = Image<float>(stored.width, stored.height);
    for (size_t i = 0; i < stored.pixels.size(); ++i) {
        Vec3 color(stored.pixels[i]);
        if (lightmap.is_srgb) color = {linear_from_srgb(color.x), linear_from_srgb(color.y), linear_from_srgb(color.z)};
        const Vec3 weights(kanikama_weights[0], kanikama_weights[1], kanikama_weights[2]);
        lightmap.light.pixels[i] =
            static_cast<float>(options.as_kanikama ? glm::dot(weights, color) : luminance(color));
    }
    const auto alpha = std::find(channels.names.begin(), channels.names.end(), "A");
    if (alpha == channels.names.end()) return lightmap;
    lightmap.alpha = Image<float>(stored.width, stored.height);
    const auto place = static_cast<size_t>(alpha - channels.names.begin());
    for (size_t i = 0; i < stored.pixels.size(); ++i)
        lightmap.alpha.pixels[i] = channels.values[i * channels.names.size() + place];
    return lightmap;
}

Pairs read_pairs(const RatioOptions& options) {
    Pairs read;
    const Path* first = nullptr;
    for (size_t c = 0; c < 3; ++c) {
        const std::vector<Path>& files = options.files[c];
        if (files.empty()) continue;
        if (!first) first = &files[0];
        read.channels.push_back(c);
        LightPair& pair =
            read.pairs.emplace_back(LightPair{read_lightmap(files[0], options), read_lightmap(files[1], options)});
        check_size(files[0], pair.shadowed.light, *first, read.pairs.front().shadowed.light);
        check_size(files[1], pair.unshadowed.light, *first, read.pairs.front().shadowed.light);
    }
    if (!first)
        throw Error(ErrorKind::usage,
                    "ratio: no lightmaps; name those of the first monitor with --red SHADOWED UNSHADOWED");
    return read;
}

glm::u8vec3 color_of_state(const std::array<TexelState, 3>& states) {
    glm::u8vec3 color;
    for (int c = 0; c < 3; ++c) {
        const TexelState state = states[static_cast<size_t>(c)];
        color[c] = state == TexelState::covered ? 255 : state == TexelState::unlit ? 100 : 0;
    }
    return color;
}

nlohmann::ordered_json as_json(const LightmapFaults& faults) {
    return {{"measured", faults.measured},
            {"without_light", faults.without_light},
            {"shadow_of_nothing", faults.shadow_of_nothing},
            {"residue", faults.residue},
            {"noisy", faults.noisy},
            {"above_one", faults.above_one},
            {"largest_ratio", faults.largest_ratio},
            {"not_finite", faults.not_finite},
            {"negative", faults.negative},
            {"least_light", faults.least_light},
            {"dark_islands", faults.dark_islands}};
}

const char* name_of(CoverageSource source) {
    return source == CoverageSource::mask ? "mask" : source == CoverageSource::alpha ? "alpha" : "light";
}

/// The channels that have lightmaps, in a map that is 1 elsewhere, and what to say of them.
struct Divided {
    VisibilityMap map;
    Image<std::array<TexelState, 3>> states;
    std::vector<std::string> warnings;
    nlohmann::ordered_json report;
    double worst_share = 0;  ///< of covered texels: above one, negative or not finite
};

Divided divide(const RatioOptions& options) {
    const auto [channels, pairs] = read_pairs(options);
    const Image<float>& any = pairs.front().unshadowed.light;
    const Image<uint8_t> mask = read_mask(options.mask);
    if (!mask.empty()) check_size(options.mask, mask, options.files[channels.front()][0], any);
    const Coverage coverage = find_coverage(pairs, mask, options.settings.threshold);
    Divided divided;
    divided.map.visibility = Image<Vec3f>(any.width, any.height, Vec3f(1));
    divided.states = Image<std::array<TexelState, 3>>(any.width, any.height);
    divided.report = {{"width", any.width},
                      {"height", any.height},
                      {"coverage", name_of(coverage.source)},
                      {"covered", coverage.texels},
                      {"islands", coverage.islands}};
    for (size_t k = 0; k < pairs.size(); ++k) {
        const auto c = static_cast<int>(channels[k]);
        const std::string name = channel_names[channels[k]];
        const RatioOfLightmaps ratio = ratio_of(pairs[k], coverage, options.settings);
        const Image<float> visibility = options.as_kanikama ? kanikama_ratio(pairs[k]) : ratio.channel.visibility;
        for (size_t i = 0; i < visibility.pixels.size(); ++i) {
            divided.map.visibility.pixels[i][c] = visibility.pixels[i];
            divided.states.pixels[i][channels[k]] = ratio.channel.state.pixels[i];
        }
        divided.report["channels"][name] = as_json(ratio.faults);
        for (std::string& line : describe(ratio.faults, name, coverage)) divided.warnings.push_back(std::move(line));
        const size_t bad = ratio.faults.above_one + ratio.faults.negative + ratio.faults.not_finite;
        divided.worst_share =
            std::max(divided.worst_share, static_cast<double>(bad) / static_cast<double>(coverage.texels));
    }
    divided.report["warnings"] = divided.warnings;
    return divided;
}

void check_outputs(const RatioOptions& options, const std::vector<Path>& outputs) {
    if (!options.validity.empty() && options.validity.extension() != ".png")
        throw Error(ErrorKind::usage, options.validity.string() + ": the picture of what was used must be a .png");
    std::error_code ignored;
    for (const Path& output : outputs)
        for (const auto& files : options.files)
            for (const Path& input : files)
                if (std::filesystem::equivalent(output, input, ignored))
                    throw Error(ErrorKind::cannot_write,
                                output.string() + ": is an input and would be overwritten; choose another -o");
}

int ratio(const RatioOptions& options) {
    const Path exr = options.out + ".visibility.exr", png = options.out + ".visibility.png";
    check_outputs(options, {exr, png, options.validity});
    Divided divided = divide(options);
    if (exr.has_parent_path()) make_folder(exr.parent_path());
    PendingFiles files;
    write_map_exr(files.add(exr), divided.map);
    write_bytes(files.add(png), encode_map_png(divided.map));
    if (!options.validity.empty()) {
        Image<glm::u8vec3> picture(divided.states.width, divided.states.height);
        std::transform(divided.states.pixels.begin(), divided.states.pixels.end(), picture.pixels.begin(),
                       color_of_state);
        write_bytes(files.add(options.validity), encode_png(picture));
    }
    files.commit();
    if (!options.quiet)
        for (const std::string& warning : divided.warnings) fmt::print(stderr, "warning: {}\n", warning);
    if (options.json)
        fmt::print("{}\n", divided.report.dump(2));
    else
        fmt::print("{}\n{}\n", exr.string(), png.string());
    if (options.limit && 100 * divided.worst_share > *options.limit)
        throw Error(
            ErrorKind::target_missed,
            fmt::format("{:.3g} % of the covered texels are above 1, negative or not finite, more than {:.3g} %",
                        100 * divided.worst_share, *options.limit));
    return 0;
}

}  // namespace

Run add_ratio_command(CLI::App& app) {
    const auto options = std::make_shared<RatioOptions>();
    CLI::App* command = app.add_subcommand(
        "ratio", "A map from lightmaps of another baker: each monitor's alone, with shadows and without");
    for (size_t c = 0; c < 3; ++c)
        command
            ->add_option(std::string("--") + channel_names[c], options->files[c],
                         std::string("The lightmaps of the monitor in this channel: direct light, no bounces; EXR, HDR "
                                     "(linear), PNG (sRGB)"))
            ->type_name("SHADOWED UNSHADOWED")
            ->expected(2);
    command->add_option("--mask", options->mask, "Where charts are: white [alpha, else where there is light]")
        ->type_name("FILE");
    command->add_flag("--linear", options->is_linear, "Codes of PNG lightmaps are linear, not sRGB");
    command
        ->add_option("--threshold", options->settings.threshold,
                     "Unshadowed light below this share of its top is residue, 0 to 0.5 [0.0001]")
        ->type_name("SHARE")
        ->check(CLI::Range(0.0, 0.5));
    command
        ->add_option("--noise", options->settings.noise,
                     "The most noise of unshadowed light, as a share of it, 0.001 to 10 [0.1]")
        ->type_name("SHARE")
        ->check(CLI::Range(0.001, 10.0));
    command->add_flag("--kanikama-compat", options->as_kanikama,
                      "Write what Kanikama's shader makes of them, neither clamped nor filled");
    command->add_option("-o,--output", options->out, "NAME.visibility.exr and .png are written [out/ratio]")
        ->type_name("NAME");
    command
        ->add_option("--validity", options->validity,
                     "Write a picture: white used, grey filled within a chart, black outside")
        ->type_name("FILE.png");
    command
        ->add_option("--fail-above", options->limit,
                     "Exit with 5 when more of the covered texels are above 1.05, negative or not finite")
        ->type_name("PERCENT");
    command->add_flag("--json", options->json, "Print what was found as JSON");
    command->add_flag("--quiet", options->quiet, "No warnings");
    return [options] { return ratio(*options); };
}

}  // namespace surimi
