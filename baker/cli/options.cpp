// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "baker/cli/config_file.h"
#include "baker/cli/fix_options.h"
#include "baker/cli/role_options.h"
#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"

namespace surimi {

void add_scene_options(CLI::App& app, Given& given) {
    app.add_option("scene", given.scene, "Scene, .gltf or .glb")->required()->type_name("SCENE");
    app.add_option("--monitor", given.monitors,
                   "Node that is a monitor, with its channel if it matters; repeatable, * and ? match")
        ->type_name("NODE[=R|G|B]")
        ->expected(1)
        ->take_all();
    app.add_option("--glass", given.glass,
                   "block: blended and transmissive surfaces cast full shadows; clear: they cast none [block]")
        ->type_name("block|clear")
        ->envname("SURIMI_GLASS");
    app.add_option("--config", given.config, "Settings file; default: SCENE's name with .surimi.toml, if it exists")
        ->type_name("FILE")
        ->envname("SURIMI_CONFIG");
    app.add_option("--threads", given.threads, "Threads to use; 0: all cores [0]")
        ->type_name("N")
        ->envname("SURIMI_THREADS");
    app.add_option("--progress", given.progress, "auto, bar, lines, json or none [auto]")
        ->type_name("STYLE")
        ->check(CLI::IsMember({"auto", "bar", "lines", "json", "none"}));
    app.add_flag("--quiet", given.quiet, "No messages and no progress; errors only");
    app.add_flag("--json", given.json, "The result as JSON on stdout");
}

void add_unwrap_options(CLI::App& app, Given& given) {
    app.add_option("--uv", given.uv,
                   "unwrap: new charts; existing: TEXCOORD_1, checked; auto: existing if fit for a lightmap, else new "
                   "charts [unwrap]")
        ->type_name("SOURCE")
        ->envname("SURIMI_UV");
    auto* size = app.add_option("--size", given.size, "Size of the map in texels, 16 to 16384; density follows [1024]")
                     ->type_name("W [H]")
                     ->expected(1, 2)
                     ->envname("SURIMI_SIZE");
    app.add_option("--density", given.density, "Texels per metre; the size follows")
        ->type_name("D")
        ->excludes(size)
        ->envname("SURIMI_DENSITY");
    app.add_option("--gutter", given.gutter, "Empty texels between two charts, 1 to 64 [2]")
        ->type_name("N")
        ->envname("SURIMI_GUTTER");
    app.add_option("--mips", given.mips, "Mip levels on which gutters still separate charts, 0 to 8 [0]")
        ->type_name("N")
        ->envname("SURIMI_MIPS");
    app.add_option("--atlases", given.atlases, "Maps to spread the surfaces over, each of the size above, 1 to 16 [1]")
        ->type_name("N")
        ->envname("SURIMI_ATLASES");
    app.add_option("--stretch", given.stretch,
                   "How much charts may be stretched before they are cut, above 1 to 10: 99 % of a chart has at least "
                   "1/S of its density in every direction [1.5]")
        ->type_name("S")
        ->envname("SURIMI_STRETCH");
    app.add_option("--uv-quality", given.uv_quality,
                   "draft, medium or high: how long fewer and longer charts are sought [medium]")
        ->type_name("QUALITY")
        ->envname("SURIMI_UV_QUALITY");
    app.add_flag("--uniform", given.is_uniform,
                 "One density for all: no fewer texels for what no monitor lights, or from afar");
    app.add_flag("--print-config", given.print_config, "Print the settings in effect as TOML and stop");
}

Config effective_config(const Given& given) {
    Config config;
    std::filesystem::path file = given.config;
    const auto beside = std::filesystem::path(given.scene).replace_extension(".surimi.toml");
    std::error_code ignored;
    if (file.empty() && std::filesystem::exists(beside, ignored)) file = beside;
    if (!file.empty()) read_config_file(file, config);

    if (given.glass) config.roles.glass = parse_glass(*given.glass, "--glass");
    UnwrapSettings& unwrap = config.bake.unwrap;
    if (given.uv) unwrap.uv = parse_uv_source(*given.uv, "--uv");
    if (!given.size.empty()) {
        unwrap.width = given.size.front();
        unwrap.height = given.size.back();
        unwrap.texels_per_metre = 0;
    }
    if (given.density) {
        unwrap.texels_per_metre = *given.density;
        if (!(*given.density > 0)) throw Error(ErrorKind::usage, "--density must be greater than 0");
    }
    if (given.gutter) unwrap.gutter = *given.gutter;
    if (given.mips) unwrap.mips = *given.mips;
    if (given.atlases) unwrap.atlases = *given.atlases;
    if (given.stretch) unwrap.stretch = *given.stretch;
    if (given.is_uniform) unwrap.is_uniform = true;
    if (given.uv_quality) unwrap.quality = parse_uv_quality(*given.uv_quality, "--uv-quality");
    if (!environment_without().empty()) do_without(environment_without(), "SURIMI_WITHOUT", config.bake);
    if (!given.without.empty()) do_without(given.without, "--without", config.bake);
    if (given.gather) {
        apply(environment_wishes(), "environment", config);
        apply(*given.gather, "command line", config);
        check_samples(config.bake.gather);
    }
    if (given.threads) config.threads = *given.threads;
    for (const std::string& text : given.monitors) config.monitors.command_line.push_back(parse_monitor_selector(text));
    check_ranges(config, "command line");
    return config;
}

namespace {

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump();
}  // JSON strings are TOML strings

std::string channel_line(const std::optional<int>& channel) {
    return channel ? fmt::format("channel = \"{}\"\n", "RGB"[*channel]) : "";
}

std::string triple(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

}  // namespace

std::string to_toml(const Config& config) {
    const UnwrapSettings& unwrap = config.bake.unwrap;
    std::string text;
    text += fmt::format("uv = \"{}\"            # unwrap, existing, auto\n", name_of(unwrap.uv));
    if (unwrap.texels_per_metre > 0)
        text += fmt::format("density = {}          # texels per metre; the size follows\n", unwrap.texels_per_metre);
    else
        text += fmt::format("size = [{}, {}]   # texels; the density follows\n", unwrap.width, unwrap.height);
    text += fmt::format("gutter = {}               # texels between charts\n", unwrap.gutter);
    text += fmt::format("mips = {}                 # levels on which gutters still separate charts\n", unwrap.mips);
    text += fmt::format("atlases = {}              # maps\n", unwrap.atlases);
    text += fmt::format("stretch = {}            # above 1\n", unwrap.stretch);
    text += fmt::format("uv-quality = \"{}\"    # draft, medium, high\n", name_of(unwrap.quality));
    text += fmt::format("uniform = {}          # one density for all\n", unwrap.is_uniform);
    text += fmt::format("glass = \"{}\"         # block: it casts full shadows; clear: none\n",
                        name_of(config.roles.glass));
    text += gather_toml(config);
    text += fixes_toml(config.bake);
    text += fmt::format("threads = {}              # 0: all cores\n", config.threads);
    for (const TexelScale& wish : unwrap.texel_scales) {
        text += "\n[[texel_scale]]\n";
        if (!wish.node.empty()) text += fmt::format("node = {}\n", quoted(wish.node));
        if (!wish.material.empty()) text += fmt::format("material = {}\n", quoted(wish.material));
        text += fmt::format("scale = {}\n", wish.scale);
    }
    text += objects_toml(config.roles);
    const bool from_command_line = !config.monitors.command_line.empty();
    for (const auto& m : from_command_line ? config.monitors.command_line : config.monitors.config_nodes)
        text += fmt::format("\n[[monitor]]\nnode = {}\n{}", quoted(m.node), channel_line(m.channel));
    if (from_command_line) return text;
    for (const auto& m : config.monitors.config_rectangles) {
        text += fmt::format("\n[[monitor]]\nname = {}\n{}radiance = {}\nrectangles = [\n", quoted(m.name),
                            channel_line(m.channel), triple(m.radiance));
        for (const auto& r : m.rectangles)
            text += fmt::format("  {{ center = {}, half_u = {}, half_v = {} }},\n", triple(r.center), triple(r.half_u),
                                triple(r.half_v));
        text += "]\n";
    }
    return text;
}

namespace {

nlohmann::ordered_json unwrap_json(const Config& config) {
    const UnwrapSettings& unwrap = config.bake.unwrap;
    nlohmann::ordered_json json;
    json["uv"] = name_of(unwrap.uv);
    if (unwrap.texels_per_metre > 0)
        json["density"] = unwrap.texels_per_metre;
    else
        json["size"] = {unwrap.width, unwrap.height};
    json["gutter"] = unwrap.gutter;
    json["mips"] = unwrap.mips;
    json["atlases"] = unwrap.atlases;
    json["stretch"] = unwrap.stretch;
    json["uniform"] = unwrap.is_uniform;
    json["uvQuality"] = name_of(unwrap.quality);
    for (const TexelScale& wish : unwrap.texel_scales) {
        nlohmann::ordered_json& item = json["texel_scale"].emplace_back();
        if (!wish.node.empty()) item["node"] = wish.node;
        if (!wish.material.empty()) item["material"] = wish.material;
        item["scale"] = wish.scale;
    }
    add_objects_json(config.roles, json);
    return json;
}

}  // namespace

std::string unwrap_settings_json(const Config& config) {
    return unwrap_json(config).dump();
}

std::string settings_json(const Config& config) {
    nlohmann::ordered_json json = unwrap_json(config);
    json["glass"] = name_of(config.roles.glass);
    add_gather_json(config, json);
    if (!without(config.bake).empty()) json["without"] = without(config.bake);
    return json.dump();
}

void print_notes(const Scene& scene) {
    for (const Note& note : scene.notes)
        fmt::print(stderr, "note: {}{}{}\n", note.what, note.count > 1 ? fmt::format(" ({} times)", note.count) : "",
                   note.where.empty() ? "" : fmt::format(", first at {}", note.where));
}

Scene load_scene(const Given& given, const Config& config) {
    Scene scene = read_gltf(given.scene);
    apply_roles(scene, config.roles);
    find_monitors(scene, config.monitors);
    if (!given.quiet) print_notes(scene);
    return scene;
}

}  // namespace surimi
