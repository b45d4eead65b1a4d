// SPDX-License-Identifier: Apache-2.0
#include "baker/report/report.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "baker/report/atlas_of_bake.h"
#include "baker/report/atlas_planes.h"
#include "baker/report/codes.h"
#include "baker/report/difference.h"
#include "baker/report/evidence_planes.h"
#include "baker/report/opening_view.h"
#include "baker/report/page.h"
#include "baker/report/scene_copy.h"
#include "baker/report/settings_text.h"
#include "baker/report/text.h"
#include "baker/write/bake_files.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/roles.h"
#include "runtime/scene/uri.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

/// Longest side of a picture of the page, pixels; larger maps are reduced by a whole factor.
constexpr int largest_picture = 2048;

/// What was read of one page of the atlas.
struct LoadedPage {
    std::optional<VisibilityMap> map;
    std::optional<Evidence> evidence;
    std::optional<ReferenceMap> reference;
};

std::vector<LoadedPage> load_pages(const BakeFiles& files, const ReportRequest& request) {
    if (!request.references.empty() && request.references.size() != files.pages.size())
        throw Error(ErrorKind::usage, "the bake has " + std::to_string(files.pages.size()) +
                                          " maps; give --reference as many times, in their order, not " +
                                          std::to_string(request.references.size()));
    std::vector<LoadedPage> pages(files.pages.size());
    for (size_t p = 0; p < pages.size(); ++p) {
        const PageOfBake& page = files.pages[p];
        if (!page.visibility_exr.empty()) pages[p].map = read_map_exr(page.visibility_exr);
        if (!page.lightmaps_exr.empty()) pages[p].evidence = read_evidence(page.lightmaps_exr, files);
        if (!request.references.empty()) pages[p].reference = read_reference(request.references[p], files);
    }
    return pages;
}

std::string png_uri(const Image<glm::u8vec3>& image) {
    return data_uri("image/png", encode_png(image));
}

/// The pictures of one page that the map and its evidence give.
Json map_pictures(const LoadedPage& page, const PageOfBake& files, int reduction) {
    Json pictures = Json::object();
    const auto png = reduction == 1 && !files.visibility_png.empty() ? read_file(files.visibility_png) : std::nullopt;
    if (png)
        pictures["map"] = data_uri("image/png", *png);
    else if (page.map)
        pictures["map"] = png_uri(draw_map(page.map->visibility, reduction));
    if (page.evidence) {
        pictures["error"] = png_uri(draw_errors(*page.evidence, reduction));
        pictures["state"] = png_uri(draw_states(*page.evidence, reduction));
    }
    if (page.map && page.evidence && page.reference)
        pictures["difference"] =
            png_uri(draw_difference(page.map->visibility, *page.reference, *page.evidence, reduction));
    return pictures;
}

Json reference_section(const std::vector<LoadedPage>& pages, const BakeFiles& files, const ReportRequest& request) {
    std::vector<ComparedPage> compared;
    for (const LoadedPage& page : pages)
        if (page.map && page.evidence && page.reference)
            compared.push_back({page.map->visibility, *page.reference, *page.evidence});
    if (compared.empty()) return Json();
    Json names = Json::array();
    for (const auto& reference : request.references) names.push_back(reference.filename().string());
    const double error = files.manifest.at("settings").value("error", 0.0);
    return {{"files", names}, {"channels", difference_section(compared, files, error)}};
}

/// The study that was asked for, or the one that lies beside the bake; null without one.
Json study_section(const BakeFiles& files, const ReportRequest& request) {
    const auto folder = files.manifest_path.parent_path();
    std::vector<std::filesystem::path> candidates{folder / (files.name + ".study.json"), folder / "study.json"};
    if (!request.study.empty()) candidates = {request.study};
    for (const auto& path : candidates) {
        const auto bytes = read_file(path);
        if (!bytes && request.study.empty()) continue;
        Json study = bytes ? Json::parse(bytes->begin(), bytes->end(), nullptr, false) : Json();
        if (!study.is_object() || !study.contains("techniques"))
            throw Error(ErrorKind::scene,
                        path.string() + ": is no study; make one with: surimi study SCENE --json > study.json");
        return study;
    }
    return {};
}

Json vector_json(const Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json view_section(const OpeningView& opening) {
    Json section{{"eye", vector_json(opening.view.eye)},
                 {"forward", vector_json(opening.view.forward)},
                 {"yfov", opening.view.yfov},
                 {"exposure", opening.exposure}};
    if (!opening.stills.shadowed.empty())
        section["stills"] = {{"unshadowed", data_uri("image/png", opening.stills.unshadowed)},
                             {"shadowed", data_uri("image/png", opening.stills.shadowed)}};
    return section;
}

/// Draws the atlas into the pictures of its pages, and tells of the scene and of the view of it.
void add_scene(const BakeFiles& files, const std::vector<LoadedPage>& pages, int reduction, Json& report) {
    Scene baked = read_gltf(files.baked_glb);
    apply_roles(baked, {});
    const Atlas atlas = atlas_of_bake(baked, files);
    const UnwrapNumbers numbers = measure(baked, atlas);
    report["atlas"] = atlas_section(atlas, numbers);
    for (int p = 0; p < atlas.pages; ++p)
        report["pages"][static_cast<size_t>(p)]["pictures"]["atlas"] =
            png_uri(draw_atlas(baked, atlas, p, numbers.density_p99, reduction));
    const SceneCopy copy = copy_scene(files.baked_glb, baked);
    report["scene"] = {{"bytes", copy.bytes}, {"mostBytes", most_scene_bytes}, {"hasTextures", copy.has_textures}};
    if (!copy.glb_gzip.empty()) report["scene"]["glb"] = data_uri("application/gzip", copy.glb_gzip);
    std::vector<VisibilityMap> maps;
    for (const LoadedPage& page : pages) maps.push_back(page.map.value_or(VisibilityMap{}));
    report["view"] = view_section(open_view(baked, files, maps, copy.glb_gzip.empty()));
}

std::string make_report_of(const BakeFiles& files, const ReportRequest& request) {
    std::vector<LoadedPage> pages = load_pages(files, request);
    const int reduction = (std::max({files.width, files.height, 1}) + largest_picture - 1) / largest_picture;
    Json report{{"manifest", files.manifest},
                {"program", "surimi " SURIMI_VERSION},
                {"name", files.name},
                {"complaints", files.complaints},
                {"command", command_of(files)},
                {"toml", toml_of(files)},
                {"codes",
                 {{"stepsPerOctave", steps_per_octave},
                  {"errorOctaves", error_octaves},
                  {"differenceOctaves", difference_octaves},
                  {"reduction", reduction}}},
                {"pages", Json::array()}};
    for (size_t p = 0; p < pages.size(); ++p)
        report["pages"].push_back({{"pictures", map_pictures(pages[p], files.pages[p], reduction)}});
    report["reference"] = reference_section(pages, files, request);
    for (LoadedPage& page : pages) page.evidence.reset();  // the largest part, and told
    if (!files.baked_glb.empty()) add_scene(files, pages, reduction, report);
    report["study"] = study_section(files, request);
    return make_page(files.name, report);
}

}  // namespace

std::string make_report(const ReportRequest& request) {
    return make_report_of(find_bake(request.bake), request);
}

std::filesystem::path write_report(const ReportRequest& request) {
    const BakeFiles files = find_bake(request.bake);
    const std::string page = make_report_of(files, request);
    const auto path =
        request.out.empty() ? files.manifest_path.parent_path() / (files.name + ".report.html") : request.out;
    write_file(path, std::span(reinterpret_cast<const uint8_t*>(page.data()), page.size()));
    return path;
}

}  // namespace surimi
