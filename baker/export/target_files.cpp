// SPDX-License-Identifier: Apache-2.0
#include "baker/export/target_files.h"

#include <algorithm>

#include "baker/export/list.h"
#include "baker/export/lobe_tables.h"
#include "baker/export/ltcgi_curve.h"
#include "baker/export/templates.h"
#include "baker/report/text.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"

namespace surimi {
namespace {

ExportFile text_file(const std::filesystem::path& name, std::string text) {
    return {name, [text = std::move(text)](const std::filesystem::path& path) {
                write_bytes(path, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
            }};
}

ExportFile binary_file(const std::filesystem::path& name, std::vector<uint8_t> bytes) {
    return {name, [bytes = std::move(bytes)](const std::filesystem::path& path) { write_bytes(path, bytes); }};
}

ExportFile template_file(const std::filesystem::path& name, std::string_view source) {
    return text_file(name, std::string(template_text(source)));
}

ExportFile copied_file(const std::filesystem::path& source) {
    return {source.filename(), [source](const std::filesystem::path& path) {
                std::error_code error;
                std::filesystem::copy_file(source, path, std::filesystem::copy_options::overwrite_existing, error);
                if (error)
                    throw Error(ErrorKind::cannot_write, path.string() + ": cannot be copied from " + source.string() +
                                                             " (" + error.message() + ")");
            }};
}

ExportFile exr_file(const std::filesystem::path& name, Channels channels, ExrDepth depth) {
    return {name, [channels = std::move(channels), depth](const std::filesystem::path& path) {
                write_exr(path, channels, depth);
            }};
}

/// Of one page; "NAME.KIND.exr", with several pages "NAME.KIND.0.exr" and so on.
std::string page_name(const BakeFiles& files, const std::string& kind, size_t page, const std::string& extension) {
    const std::string number = files.pages.size() > 1 ? "." + std::to_string(page) : "";
    return files.name + "." + kind + number + extension;
}

std::vector<std::string> page_names(const BakeFiles& files, const std::string& kind, const std::string& extension) {
    std::vector<std::string> names;
    for (size_t page = 0; page < files.pages.size(); ++page) names.push_back(page_name(files, kind, page, extension));
    return names;
}

/// The map as a file; `value` of a visibility. With `alpha`, a fourth channel of that value for a light that is not
/// there.
template <class Value>
ExportFile map_file(const ExportedBake& bake, size_t page, const std::string& kind, bool has_alpha,
                    const Value& value) {
    const Image<Vec3f>& map = bake.pages[page].visibility;
    Channels channels{map.width, map.height, {"R", "G", "B"}, {}};
    if (has_alpha) channels.names.emplace_back("A");
    channels.values.reserve(map.pixels.size() * channels.names.size());
    for (const Vec3f& visibility : map.pixels) {
        for (int c = 0; c < 3; ++c)
            channels.values.push_back(static_cast<float>(value(static_cast<double>(visibility[c]))));
        if (has_alpha) channels.values.push_back(static_cast<float>(value(1.0)));
    }
    return exr_file(page_name(bake.files, kind, page, ".exr"), std::move(channels), ExrDepth::half);
}

double as_it_is(double visibility) {
    return visibility;
}

/// Which model the map fits.
std::string uv_sentence(const BakeFiles& files) {
    const auto uv = files.manifest.value("map", nlohmann::ordered_json()).value("uv", nlohmann::ordered_json());
    const std::string glb = "`" + files.baked_glb.filename().string() + "`";
    if (uv.value("source", "unwrap") == "existing")
        return "The map was baked into the lightmap UVs that the model had already (its second set, TEXCOORD_1 in "
               "glTF, "
               "UV2 in engines). So the model that you have in your project fits as it is, FBX included, as long as "
               "those UVs are its own; scale and offset are 1, 1, 0, 0.";
    return "The map was baked into new UVs: the second set (TEXCOORD_1) of " + glb +
           ", so that model has to be used, or one made from it (Blender keeps the set in FBX). They are places in "
           "the whole map; scale and offset are 1, 1, 0, 0. To bake into the lightmap UVs of your own model instead: "
           "`surimi bake --uv existing`.";
}

std::string readme(const ExportedBake& bake, std::string_view source, const std::vector<std::string>& maps) {
    const BakeFiles& files = bake.files;
    std::string map_list, monitors;
    for (const std::string& map : maps) map_list += (map_list.empty() ? "`" : ", `") + map + "`";
    for (const BakedMonitor& monitor : files.monitors)
        monitors += (monitors.empty() ? "" : ", ") + std::string(1, "RGB"[monitor.channel]) + " = " +
                    markdown_text(monitor.name);
    return fill_in(template_text(source), {{"name", files.name},
                                           {"glb", files.baked_glb.filename().string()},
                                           {"list", files.name + ".surimi.json"},
                                           {"maps", map_list},
                                           {"monitors", monitors},
                                           {"uv", uv_sentence(files)}});
}

/// What Kanikama and LTCGI have in common: a list, and the component that reads it.
void add_component(const ExportedBake& bake, const ListWishes& wishes, ExportFiles& files) {
    files.push_back(text_file(bake.files.name + ".surimi.json", make_list(bake.files, wishes)));
    files.push_back(template_file("SurimiVisibility.cs", "unity/SurimiVisibility.cs"));
    files.push_back(template_file("Editor/SurimiSetup.cs", "unity/Editor/SurimiSetup.cs"));
}

void add_importer(ExportFiles& files) {
    files.push_back(template_file("Editor/SurimiTextureImporter.cs", "unity/Editor/SurimiTextureImporter.cs"));
}

}  // namespace

ExportFiles kanikama_files(const ExportedBake& bake) {
    ExportFiles files;
    for (size_t p = 0; p < bake.pages.size(); ++p) files.push_back(map_file(bake, p, "visibility", false, as_it_is));
    const std::vector<std::string> maps = page_names(bake.files, "visibility", ".exr");
    add_component(bake, {Axes::unity, maps, "_Udon_LTC_VisibilityMap", ""}, files);
    add_importer(files);
    files.push_back(text_file("README.md", readme(bake, "unity/kanikama.md", maps)));
    return files;
}

ExportFiles ltcgi_files(const ExportedBake& bake) {
    ExportFiles files;
    for (size_t p = 0; p < bake.pages.size(); ++p)
        files.push_back(map_file(bake, p, "visibility-ltcgi", false, ltcgi_map_value));
    const std::vector<std::string> maps = page_names(bake.files, "visibility-ltcgi", ".exr");
    add_component(bake, {Axes::unity, maps, "_Udon_LTCGI_Lightmap", "_Udon_LTCGI_LightmapST"}, files);
    add_importer(files);
    files.push_back(text_file("README.md", readme(bake, "unity/ltcgi.md", maps)));
    return files;
}

ExportFiles arealit_files(const ExportedBake& bake) {
    ExportFiles files;
    for (size_t p = 0; p < bake.pages.size(); ++p)
        files.push_back(map_file(bake, p, "visibility-arealit", true, as_it_is));
    add_importer(files);
    files.push_back(
        text_file("README.md", readme(bake, "unity/arealit.md", page_names(bake.files, "visibility-arealit", ".exr"))));
    return files;
}

ExportFiles godot_files(const ExportedBake& bake) {
    const size_t quads = listed_quads(bake.files, Axes::gltf).size();
    if (quads > most_godot_quads)
        throw Error(ErrorKind::usage, bake.files.manifest_path.string() + ": its monitors have " +
                                          std::to_string(quads) + " quads, and the shader for Godot has room for " +
                                          std::to_string(most_godot_quads) +
                                          "; leave the target godot out, or bake with simpler monitors");
    ExportFiles files;
    for (size_t p = 0; p < bake.pages.size(); ++p) {
        files.push_back(map_file(bake, p, "visibility", false, as_it_is));
        files.push_back(copied_file(bake.files.pages[p].visibility_png));
    }
    files.push_back(copied_file(bake.files.baked_glb));
    const std::vector<std::string> maps = page_names(bake.files, "visibility", ".exr");
    files.push_back(text_file(bake.files.name + ".surimi.json", make_list(bake.files, {Axes::gltf, maps, "", ""})));
    files.push_back(binary_file("surimi_lobes.bin", lobe_tables()));
    for (const char* name : {"surimi.gdshader", "surimi_lights.gdshaderinc", "surimi_apply.gd", "surimi_import.gd"})
        files.push_back(template_file(name, std::string("godot/") + name));
    files.push_back(text_file("README.md", readme(bake, "godot/README.md", maps)));
    return files;
}

ExportFiles three_files(const ExportedBake& bake) {
    ExportFiles files{copied_file(bake.files.baked_glb)};
    const std::string name = script_text(bake.files.baked_glb.filename().string());
    files.push_back(text_file("index.html", fill_in(template_text("web/three.html"), {{"glb", name}})));
    files.push_back(text_file("README.md", readme(bake, "web/three.md", {})));
    return files;
}

}  // namespace surimi
