// SPDX-License-Identifier: Apache-2.0
#include "baker/report/atlas_of_bake.h"

#include <map>
#include <string>
#include <utility>

#include "baker/unwrap/existing.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

/// The page of each surface; -1: it is on none.
std::vector<int> pages_of(const Scene& baked, const BakeFiles& files) {
    std::map<std::pair<int, std::string>, int> listed;
    for (const Json& node : files.manifest.value("nodes", Json::array()))
        for (const Json& surface : node.value("surfaces", Json::array()))
            listed[{node.value("node", -1), surface.get<std::string>()}] = node.value("page", 0);
    std::vector<int> pages;
    for (const Surface& surface : baked.surfaces) {
        const auto found = listed.find({surface.node, surface.name});
        pages.push_back(found != listed.end() && surface.uv_sets.size() > 1 ? found->second : -1);
    }
    return pages;
}

/// Adds the charts and coordinates of the surfaces of one page.
void add_page(const Atlas& page, int number, Atlas& atlas) {
    const auto first_chart = static_cast<uint32_t>(atlas.charts.size());
    for (size_t s = 0; s < page.surfaces.size(); ++s) {
        if (page.surfaces[s].uv.empty()) continue;
        atlas.surfaces[s] = page.surfaces[s];
        atlas.surfaces[s].page = number;
        for (uint32_t& chart : atlas.surfaces[s].chart) chart += first_chart;
    }
    atlas.charts.insert(atlas.charts.end(), page.charts.begin(), page.charts.end());
}

}  // namespace

Atlas atlas_of_bake(Scene& baked, const BakeFiles& files) {
    const std::vector<int> pages = pages_of(baked, files);
    UnwrapSettings settings;
    settings.uv = UvSource::existing;
    settings.width = files.width;
    settings.height = files.height;
    Atlas atlas;
    atlas.width = files.width;
    atlas.height = files.height;
    atlas.pages = static_cast<int>(files.pages.size());
    atlas.is_existing = true;
    atlas.surfaces.resize(baked.surfaces.size());
    for (int page = 0; page < atlas.pages; ++page) {
        for (size_t s = 0; s < pages.size(); ++s) baked.surfaces[s].receives = pages[s] == page;
        add_page(judge_existing(baked, settings).atlas, page, atlas);
    }
    for (size_t s = 0; s < pages.size(); ++s) baked.surfaces[s].receives = pages[s] >= 0;
    atlas.texels_per_metre = files.manifest.at("map").value("texelsPerMetre", 0.0);
    return atlas;
}

}  // namespace surimi
