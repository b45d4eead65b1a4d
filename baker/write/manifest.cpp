// SPDX-License-Identifier: Apache-2.0
#include "baker/write/manifest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "baker/unwrap/density.h"
#include "baker/write/evidence_sections.h"
#include "baker/write/manifest_sections.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;  // keeps what belongs together side by side

constexpr int format_version = 1;

std::string channel_name(int channel) {
    return std::string(1, "RGB"[channel]);
}

Json json_of(const Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json map_section(const Atlas& atlas, const std::vector<ManifestFile>& files) {
    Json section{{"files", Json::array()},
                 {"width", atlas.width},
                 {"height", atlas.height},
                 {"encoding", {{"exr", "linear"}, {"png", "srgb"}}},
                 {"uvSet", 1},
                 {"uv", uv_section(atlas)},
                 {"origin", "top-left"},
                 {"texelsPerMetre", atlas.texels_per_metre},
                 {"gutter", atlas.gutter}};
    for (int page = 0; page < atlas.pages && atlas.pages > 1; ++page)
        section["pages"].push_back({{"page", page}, {"files", Json::array()}});
    for (const ManifestFile& file : files) {
        if (file.role != "visibility") continue;
        section["files"].push_back(file.name);
        if (atlas.pages > 1) section["pages"][static_cast<size_t>(file.page)]["files"].push_back(file.name);
    }
    return section;
}

/// Width, height, left and top of the rectangle that the surfaces' charts lie in.
Json rectangle_of(const Atlas& atlas, const std::vector<size_t>& surfaces) {
    Vec2 low(INFINITY);
    Vec2 high(-INFINITY);
    for (const size_t s : surfaces)
        for (const auto& corners : atlas.surfaces[s].uv)
            for (const Vec2f& uv : corners) {
                low = glm::min(low, Vec2(uv));
                high = glm::max(high, Vec2(uv));
            }
    if (!(low.x <= high.x && low.y <= high.y)) return Json::array({0, 0, 0, 0});
    return Json::array({high.x - low.x, high.y - low.y, low.x, low.y});
}

Json nodes_section(const Scene& scene, const Atlas& atlas) {
    std::map<std::pair<int, int>, std::vector<size_t>> surfaces_by_place;
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        if (!atlas.surfaces[s].uv.empty())
            surfaces_by_place[{scene.surfaces[s].node, atlas.surfaces[s].page}].push_back(s);
    Json section = Json::array();
    for (const auto& [place, surfaces] : surfaces_by_place) {
        const auto& [node, page] = place;
        Json names = Json::array();
        for (const size_t s : surfaces) names.push_back(scene.surfaces[s].name);
        Json entry{{"name", scene.nodes[static_cast<size_t>(node)].name}, {"node", node}, {"surfaces", names}};
        if (atlas.pages > 1) entry["page"] = page;
        entry["st"] = rectangle_of(atlas, surfaces);
        section.push_back(std::move(entry));
    }
    return section;
}

Json monitors_section(const Scene& scene) {
    Json section = Json::array();
    for (const Monitor& monitor : scene.monitors) {
        Json panels = Json::array();
        for (const Polygon& panel : monitor.panels) {
            Json corners = Json::array();
            for (const Vec3& corner : panel.corners) corners.push_back(json_of(corner));
            panels.push_back(corners);
        }
        const bool has_node = monitor.node >= 0;
        section.push_back({{"channel", channel_name(monitor.channel)},
                           {"name", monitor.name},
                           {"node", has_node ? Json(monitor.node) : Json()},
                           {"reason", monitor.reason},
                           {"corners", panels},
                           {"radiance", json_of(monitor.radiance)},
                           {"areaSquareMetres", area(monitor)},
                           {"twoSided", monitor.two_sided}});
    }
    return section;
}

Json texels_section(const Scene& scene, const Bake& bake) {
    constexpr std::array states{std::pair{"covered", TexelState::covered}, std::pair{"unlit", TexelState::unlit},
                                std::pair{"inside", TexelState::inside}, std::pair{"filled", TexelState::filled},
                                std::pair{"empty", TexelState::empty}};
    Json section = Json::object();
    for (const Monitor& monitor : scene.monitors) {
        for (const auto& [name, state] : states) {
            std::ptrdiff_t count = 0;
            for (const BakedPage& page : bake.pages) {
                const auto& pixels = page.state[static_cast<size_t>(monitor.channel)].pixels;
                count += std::count(pixels.begin(), pixels.end(), state);
            }
            section[channel_name(monitor.channel)][name] = count;
        }
    }
    return section;
}

}  // namespace

Json uv_section(const Atlas& atlas) {
    Json section{{"source", atlas.is_existing ? "existing" : "unwrap"}};
    if (!atlas.uv_reason.empty()) section["reason"] = atlas.uv_reason;
    return section;
}

Json weights_section(const Scene& scene, const Atlas& atlas) {
    Json section = Json::array();
    for (const DensityWeight& weight : atlas.weights)
        section.push_back({{"surface", scene.surfaces[weight.surface].name},
                           {"cause", name_of(weight.cause)},
                           {"charts", weight.charts},
                           {"areaSquareMetres", weight.area},
                           {"shareOfSurface", weight.area_share},
                           {"shareOfTexels", weight.texel_share},
                           {"factor", {weight.least, weight.most}}});
    return section;
}

Json notes_section(const Scene& scene) {
    Json section = Json::array();
    for (const Note& note : scene.notes)
        section.push_back({{"what", note.what}, {"count", note.count}, {"where", note.where}});
    return section;
}

namespace {

Json outputs_section(const std::vector<ManifestFile>& files, int page_count) {
    Json section = Json::array();
    for (const ManifestFile& file : files) {
        section.push_back({{"role", file.role}, {"file", file.name}, {"bytes", file.size}, {"hash", file.hash}});
        if (page_count > 1 && file.page >= 0) section.back()["page"] = file.page;
    }
    return section;
}

}  // namespace

void ContentHash::add(std::span<const uint8_t> bytes) {
    constexpr uint64_t prime = 0x00000100000001B3;
    for (const uint8_t byte : bytes) hash_ = (hash_ ^ byte) * prime;
}

std::string ContentHash::text() const {
    std::string text = "fnv1a64:";
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[hash_ >> shift & 0xF];
    return text;
}

std::string content_hash(std::span<const uint8_t> bytes) {
    ContentHash hash;
    hash.add(bytes);
    return hash.text();
}

std::string make_manifest(const Scene& scene, const Bake& bake, const std::string& settings_json,
                          const std::string& scene_hash, const std::vector<ManifestFile>& files) {
    Json rays = Json::object();
    Json stages = Json::array();
    for (const StageCost& cost : bake.costs) {
        if (cost.rays > 0) rays[cost.stage] = cost.rays;
        stages.push_back({{"stage", cost.stage}, {"seconds", cost.seconds}, {"peakBytes", cost.peak_bytes}});
    }
    const Json manifest{{"version", format_version},
                        {"generator", "surimi " SURIMI_VERSION},
                        {"scene", {{"file", scene.path.filename().string()}, {"hash", scene_hash}}},
                        {"settings", Json::parse(settings_json)},
                        {"map", map_section(bake.atlas, files)},
                        {"nodes", nodes_section(scene, bake.atlas)},
                        {"monitors", monitors_section(scene)},
                        {"texels", texels_section(scene, bake)},
                        {"error", error_section(scene, bake)},
                        {"evidence", evidence_section(scene, bake)},
                        {"rays", rays},
                        {"densityWeights", weights_section(scene, bake.atlas)},
                        {"warnings", bake.warnings},
                        {"notes", notes_section(scene)},
                        {"outputs", outputs_section(files, bake.atlas.pages)},
                        {"run", {{"stages", stages}, {"monitors", monitor_seconds_section(scene, bake)}}}};
    return manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surimi
