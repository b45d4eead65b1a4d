// SPDX-License-Identifier: Apache-2.0
#include "baker/write/unwrap_report.h"

#include <nlohmann/json.hpp>

#include "baker/write/manifest_sections.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format_version = 1;

Json map_section(const Atlas& atlas) {
    return {{"width", atlas.width},   {"height", atlas.height},
            {"pages", atlas.pages},   {"uvSet", 1},
            {"origin", "top-left"},   {"uv", uv_section(atlas)},
            {"gutter", atlas.gutter}, {"texelsPerMetre", atlas.texels_per_metre}};
}

Json quality_section(const UnwrapNumbers& n) {
    return {{"densityEfficiency", n.density_efficiency},
            {"areaShare", n.area_share},
            {"touchedShare", n.touched_share},
            {"texelsPerMetre", {{"p1", n.density_p1}, {"p50", n.density_p50}, {"p99", n.density_p99}}},
            {"stretch", {{"l2", n.l2_stretch}, {"linf", n.linf_stretch}}},
            {"symmetricDirichlet", n.symmetric_dirichlet},
            {"angle", {{"mean", n.angle_mean}, {"p99", n.angle_p99}}},
            {"area", {{"mean", n.area_mean}, {"p99", n.area_p99}}},
            {"seams",
             {{"metres", n.seam_length},
              {"overRootArea", n.seam_over_root_area},
              {"smoothMetres", n.smooth_seam_length},
              {"smoothOverRootArea", n.smooth_seam_over_root_area}}}};
}

Json meshes_section(const MeshCounts& meshes) {
    return {{"components", meshes.components},          {"openEdges", meshes.open_edges},
            {"branchingEdges", meshes.branching_edges}, {"opposedEdges", meshes.opposed_edges},
            {"doubledFaces", meshes.doubled_faces},     {"slivers", meshes.slivers}};
}

Json outputs_section(const std::vector<UnwrapFile>& files, int pages) {
    Json section = Json::array();
    for (const UnwrapFile& file : files) {
        Json entry{{"role", file.role}, {"file", file.name}};
        if (pages > 1 && file.page >= 0) entry["page"] = file.page;
        if (file.high > 0) entry["scale"] = {{"black", file.low}, {"paleYellow", file.high}, {"unit", file.unit}};
        section.push_back(std::move(entry));
    }
    return section;
}

}  // namespace

std::string make_unwrap_report(const Scene& scene, const Unwrapped& unwrapped, const std::vector<UnwrapFile>& files) {
    const UnwrapNumbers& n = unwrapped.numbers;
    const Json report{
        {"version", format_version},
        {"generator", "surimi " SURIMI_VERSION},
        {"scene", {{"file", scene.path.filename().string()}}},
        {"settings", Json::parse(unwrapped.settings_json)},
        {"map", map_section(unwrapped.atlas)},
        {"squareMetres", n.area},
        {"triangles",
         {{"count", n.triangles}, {"degenerate", n.degenerate_triangles}, {"collapsed", n.collapsed_triangles}}},
        {"meshes", meshes_section(unwrapped.atlas.meshes)},
        {"charts",
         {{"count", n.charts}, {"singleTriangle", n.single_triangle_charts}, {"mirrored", n.mirrored_charts}}},
        {"quality", quality_section(n)},
        {"densityWeights", weights_section(scene, unwrapped.atlas)},
        {"warnings", unwrapped.atlas.warnings},
        {"notes", notes_section(scene)},
        {"outputs", outputs_section(files, unwrapped.atlas.pages)},
        {"run", {{"seconds", unwrapped.seconds}}}};
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surimi
