// SPDX-License-Identifier: Apache-2.0
#include "baker/write/monitor_nodes.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <string>

namespace surimi {
namespace {

constexpr const char* channel_names = "RGB";

void set_extra(Json& object, const char* key, const Json& value) {
    if (!object.contains("extras") || object["extras"].is_object()) object["extras"][key] = value;
}

bool is_marked(const Json& node) {
    if (!node.contains("extras") || !node["extras"].is_object()) return false;
    const Json mark = node["extras"].value("monitor", Json());
    return !mark.is_null() && mark != false;
}

void append_floats(std::vector<uint8_t>& bytes, const Vec3& v) {
    const Vec3f value(v);
    const size_t offset = bytes.size();
    bytes.resize(offset + sizeof value);
    std::memcpy(&bytes[offset], &value, sizeof value);
}

/// The panels as one mesh in world space, each a fan around its first corner.
Json monitor_primitive(GltfEdit& edit, const Monitor& monitor) {
    std::vector<uint8_t> positions;
    std::vector<uint8_t> normals;
    std::vector<uint8_t> indices;
    uint32_t first = 0;
    for (const Polygon& panel : monitor.panels) {
        for (const Vec3& corner : panel.corners) {
            append_floats(positions, corner);
            append_floats(normals, front_normal(panel));
        }
        const auto count = static_cast<uint32_t>(panel.corners.size());
        for (uint32_t i = 1; i + 1 < count; ++i)
            for (const uint32_t corner : {first, first + i, first + i + 1})
                for (int shift = 0; shift < 32; shift += 8) indices.push_back(static_cast<uint8_t>(corner >> shift));
        first += count;
    }
    const Json vector{{"componentType", 5126}, {"type", "VEC3"}};
    const Json index{{"componentType", 5125}, {"type", "SCALAR"}};
    const int position = edit.add_accessor(-1, vector, std::move(positions), ViewTarget::vertices);
    edit.correct_bounds(position);
    const int normal = edit.add_accessor(-1, vector, std::move(normals), ViewTarget::vertices);
    Json primitive{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}};
    primitive["indices"] = edit.add_accessor(-1, index, std::move(indices), ViewTarget::indices);
    return primitive;
}

/// Black but for its light. glTF's factor ends at 1; what is brighter goes into the strength.
Json monitor_material(Json& document, const Monitor& monitor) {
    const double peak = std::max({monitor.radiance.x, monitor.radiance.y, monitor.radiance.z, 1.0});
    const Vec3 factor = monitor.radiance / peak;
    Json material{{"name", monitor.name}, {"emissiveFactor", {factor.x, factor.y, factor.z}}};
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}};
    if (peak > 1) {
        material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", peak}};
        declare_extension(document, "KHR_materials_emissive_strength", true);
    }
    if (monitor.two_sided) material["doubleSided"] = true;
    return material;
}

void add_monitor_node(GltfEdit& edit, const Monitor& monitor) {
    Json& document = edit.json();
    Json primitive = monitor_primitive(edit, monitor);
    primitive["material"] = list_of(document, "materials").size();
    document["materials"].push_back(monitor_material(document, monitor));
    Json node{{"name", monitor.name}, {"mesh", list_of(document, "meshes").size()}};
    node["extras"]["monitor"] = std::string(1, channel_names[monitor.channel]);
    if (monitor.two_sided) node["extras"]["monitor_two_sided"] = true;
    document["meshes"].push_back({{"name", monitor.name}, {"primitives", Json::array({primitive})}});
    const size_t scene_count = list_of(document, "scenes").size();
    const int shown = std::max(index_of(document, "scene", scene_count), 0);
    if (scene_count > 0)
        document["scenes"][static_cast<size_t>(shown)]["nodes"].push_back(list_of(document, "nodes").size());
    document["nodes"].push_back(std::move(node));
}

}  // namespace

void mark_monitors(GltfEdit& edit, const Scene& scene) {
    std::set<size_t> monitor_nodes;
    for (const Monitor& monitor : scene.monitors) {
        if (monitor.node < 0) continue;
        const auto index = static_cast<size_t>(monitor.node);
        monitor_nodes.insert(index);
        Json& node = edit.json().at("nodes").at(index);
        if (!node.contains("name")) node["name"] = monitor.name;  // the materials name it
        set_extra(node, "monitor", std::string(1, channel_names[monitor.channel]));
    }
    for (size_t n = 0; n < list_of(edit.json(), "nodes").size(); ++n)
        if (monitor_nodes.count(n) == 0 && is_marked(edit.json()["nodes"][n]))
            set_extra(edit.json()["nodes"][n], "monitor", false);
    for (const Monitor& monitor : scene.monitors)
        if (monitor.node < 0) add_monitor_node(edit, monitor);
}

}  // namespace surimi
