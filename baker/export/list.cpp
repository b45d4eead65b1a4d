// SPDX-License-Identifier: Apache-2.0
#include "baker/export/list.h"

#include <algorithm>
#include <charconv>

#include "runtime/base/error.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

/// "Wall/2" of the node "Wall" -> 2; a mesh of one primitive has the node's name.
int primitive_of(const std::string& surface, const std::string& node) {
    int number = 0;
    if (surface.size() > node.size() + 1)
        std::from_chars(surface.data() + node.size() + 1, surface.data() + surface.size(), number);
    return number;
}

/// Calls `read` and tells the user's word for what a manifest lacks.
template <class Read>
auto from_manifest(const BakeFiles& bake, const Read& read) {
    try {
        return read(bake.manifest);
    } catch (const Json::exception& error) {
        throw Error(ErrorKind::scene,
                    bake.manifest_path.string() + ": is no manifest of a bake (" + error.what() + "); bake again");
    }
}

Vec3 corner_of(const Json& numbers, Axes axes) {
    const Vec3 corner(numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>());
    return axes == Axes::unity ? Vec3(0.0 - corner.x, corner.y, corner.z) : corner;
}

Json corners_of(const ListedQuad& quad) {
    Json numbers = Json::array();
    for (const Vec3& corner : quad.corners)
        for (int k = 0; k < 3; ++k) numbers.push_back(corner[k]);
    return numbers;
}

}  // namespace

std::vector<ListedObject> listed_objects(const BakeFiles& bake) {
    return from_manifest(bake, [](const Json& manifest) {
        std::vector<ListedObject> objects;
        for (const Json& node : manifest.at("nodes")) {
            ListedObject& object = objects.emplace_back();
            object.name = node.at("name").get<std::string>();
            object.map = node.value("page", 0);
            for (const Json& surface : node.at("surfaces"))
                object.primitives.push_back(primitive_of(surface.get<std::string>(), object.name));
        }
        return objects;
    });
}

std::vector<ListedQuad> listed_quads(const BakeFiles& bake, Axes axes) {
    return from_manifest(bake, [&](const Json& manifest) {
        std::vector<ListedQuad> quads;
        const Json& monitors = manifest.at("monitors");
        for (const Json& monitor : monitors) {
            const auto channel = std::string("RGB").find(monitor.at("channel").get<std::string>());
            for (const Json& panel : monitor.at("corners"))
                for (size_t i = 1; i + 1 < panel.size(); i += 2) {
                    ListedQuad& quad = quads.emplace_back();
                    quad.channel = static_cast<int>(channel);
                    quad.is_two_sided = monitor.value("twoSided", false);
                    const size_t places[4] = {0, i, i + 1, std::min(i + 2, panel.size() - 1)};
                    for (size_t k = 0; k < 4; ++k) quad.corners[k] = corner_of(panel.at(places[k]), axes);
                }
        }
        return quads;
    });
}

std::string make_list(const BakeFiles& bake, const ListWishes& wishes) {
    Json list{{"version", 1},
              {"generator", bake.manifest.value("generator", "surimi")},
              {"texture", wishes.texture},
              {"scaleOffset", wishes.scale_offset},
              {"maps", wishes.maps},
              {"objects", Json::array()},
              {"monitors", Json::array()}};
    const bool has_pages = bake.pages.size() > 1;
    for (const ListedObject& object : listed_objects(bake)) {
        Json entry{{"name", object.name}, {"map", object.map}, {"st", {1, 1, 0, 0}}};
        // With one map there is no need to tell a mesh's parts apart.
        entry["primitives"] = has_pages ? Json(object.primitives) : Json::array();
        list["objects"].push_back(std::move(entry));
    }
    for (const BakedMonitor& monitor : bake.monitors)
        list["monitors"].push_back({{"name", monitor.name}, {"channel", monitor.channel}});
    const auto with_radiance = [&](const Json& manifest) {
        for (size_t m = 0; m < list["monitors"].size(); ++m)
            list["monitors"][m]["radiance"] = manifest.at("monitors").at(m).at("radiance");
        return true;
    };
    from_manifest(bake, with_radiance);
    list["quads"] = Json::array();
    for (const ListedQuad& quad : listed_quads(bake, wishes.axes))
        list["quads"].push_back(
            {{"channel", quad.channel}, {"twoSided", quad.is_two_sided}, {"corners", corners_of(quad)}});
    return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surimi
