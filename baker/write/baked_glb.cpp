// SPDX-License-Identifier: Apache-2.0
#include "baker/write/baked_glb.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "baker/write/gltf_edit.h"
#include "baker/write/map_carriers.h"
#include "baker/write/monitor_nodes.h"
#include "baker/write/split_vertices.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr int mode_triangles = 4;
constexpr int mode_strip = 5;
constexpr int mode_fan = 6;

/// A surface and the primitive of the output that it becomes.
struct Placement {
    size_t surface = 0;
    size_t mesh = 0;
    size_t primitive = 0;
    int page = 0;
    SplitVertices split;
    bool is_in_place = false;      ///< the file's TEXCOORD_1 is what the atlas says: nothing to do
    bool drops_first_set = false;  ///< TEXCOORD_0 was only a stand-in for TEXCOORD_1
    int moved_set = 0;             ///< where the former TEXCOORD_1 goes, because a material reads it; 0: nowhere
};

Json& primitive_of(Json& document, const Placement& placement) {
    return document["meshes"][placement.mesh]["primitives"][placement.primitive];
}

/// Gives every node with surfaces a mesh of its own. The first one keeps the mesh that it has, unless nodes
/// without surfaces use it as well.
std::vector<Placement> place_meshes(Json& document, const Scene& scene, const Atlas& atlas) {
    assert(atlas.surfaces.size() == scene.surfaces.size());
    std::map<int, std::vector<size_t>> surfaces_of_node;
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        if (!atlas.surfaces[s].uv.empty()) surfaces_of_node[scene.surfaces[s].node].push_back(s);
    std::set<size_t> taken;
    const Json& nodes = list_of(document, "nodes");
    for (size_t n = 0; n < nodes.size(); ++n)
        if (surfaces_of_node.count(static_cast<int>(n)) == 0) taken.insert(nodes[n].value("mesh", size_t{SIZE_MAX}));

    std::vector<Placement> placements;
    const Json originals = document.value("meshes", Json::array());
    for (const auto& [node, surfaces] : surfaces_of_node) {
        size_t mesh = document.at("nodes").at(static_cast<size_t>(node)).at("mesh").get<size_t>();
        if (!taken.insert(mesh).second) {
            document["meshes"].push_back(originals.at(mesh));
            mesh = document["meshes"].size() - 1;
            document["nodes"][static_cast<size_t>(node)]["mesh"] = mesh;
        }
        for (const size_t s : surfaces) {
            const auto primitive = static_cast<size_t>(scene.surfaces[s].primitive);
            document["meshes"][mesh]["primitives"].at(primitive);
            Placement placement;
            placement.surface = s;
            placement.mesh = mesh;
            placement.primitive = primitive;
            placement.page = atlas.surfaces[s].page;
            placements.push_back(std::move(placement));
        }
    }
    return placements;
}

/// The triangles of a primitive in the order and winding of the file (glTF 2.0, 3.7.2.1).
std::vector<Triangle> file_triangles(const GltfEdit& edit, const Json& primitive, size_t vertex_count) {
    std::vector<uint32_t> corners;
    if (primitive.contains("indices")) {
        corners = edit.source_indices(primitive["indices"].get<int>());
    } else {
        corners.resize(vertex_count);
        for (size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<uint32_t>(i);
    }
    const int mode = primitive.value("mode", mode_triangles);
    std::vector<Triangle> triangles;
    if (mode == mode_triangles)
        for (size_t i = 0; i + 2 < corners.size(); i += 3)
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    if (mode == mode_strip)
        for (size_t i = 0; i + 2 < corners.size(); ++i)
            triangles.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    if (mode == mode_fan)
        for (size_t i = 0; i + 2 < corners.size(); ++i)
            triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
    return triangles;
}

bool has_atlas_uv(const Surface& surface, const SurfaceUv& uv) {
    if (surface.uv_sets.size() < 2) return false;
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        for (size_t c = 0; c < 3; ++c)
            if (Vec2f(surface.uv_sets[1][surface.triangles[t][c]]) != uv.uv[t][c]) return false;
    return true;
}

void plan_split(const GltfEdit& edit, const Json& primitive, const Surface& surface, const SurfaceUv& uv,
                Placement& placement) {
    const Json& attributes = primitive.at("attributes");
    const int position = attributes.at("POSITION").get<int>();
    const auto vertex_count = edit.source_accessor(position).at("count").get<size_t>();
    const auto triangles = file_triangles(edit, primitive, vertex_count);
    placement.split = split_vertices(surface, uv, triangles, vertex_count);
    placement.is_in_place = attributes.contains("TEXCOORD_1") && has_atlas_uv(surface, uv);
    if (placement.is_in_place || !attributes.contains("TEXCOORD_1")) return;
    if (reads_set(edit.json(), primitive, 1)) {
        placement.moved_set = 2;
        while (attributes.contains("TEXCOORD_" + std::to_string(placement.moved_set))) ++placement.moved_set;
    } else {
        placement.drops_first_set =
            attributes.value("TEXCOORD_0", Json()) == attributes["TEXCOORD_1"] && !reads_set(edit.json(), primitive, 0);
    }
}

void add_all_accessors(const Json& primitive, std::set<int>& accessors) {
    for (const Json& accessor : primitive.at("attributes")) accessors.insert(accessor.get<int>());
    for (const Json& target : list_of(primitive, "targets"))
        for (const Json& accessor : target) accessors.insert(accessor.get<int>());
    accessors.insert(primitive.value("indices", -1));
}

/// The attributes that the old data of a placement goes to: without the former TEXCOORD_1, or with it moved.
Json attributes_to_carry(const Json& primitive, const Placement& placement) {
    Json attributes = primitive.at("attributes");
    if (placement.moved_set > 0)
        attributes["TEXCOORD_" + std::to_string(placement.moved_set)] = attributes["TEXCOORD_1"];
    attributes.erase("TEXCOORD_1");
    if (placement.drops_first_set) attributes.erase("TEXCOORD_0");
    return attributes;
}

bool keeps_indices(const Json& primitive, const Placement& placement) {
    return placement.split.is_unchanged && primitive.contains("indices") &&
           primitive.value("mode", mode_triangles) == mode_triangles;
}

/// The accessors that the output still needs as they are.
std::set<int> kept_accessors(const Json& document, const std::vector<Placement>& placements) {
    std::map<std::pair<size_t, size_t>, const Placement*> rewritten;
    for (const Placement& placement : placements)
        if (!placement.is_in_place) rewritten[{placement.mesh, placement.primitive}] = &placement;
    std::set<int> kept;
    const Json& meshes = list_of(document, "meshes");
    for (size_t m = 0; m < meshes.size(); ++m)
        for (size_t p = 0; p < meshes[m].at("primitives").size(); ++p) {
            Json primitive = meshes[m]["primitives"][p];
            const auto found = rewritten.find({m, p});
            if (found != rewritten.end()) {
                const bool keeps = keeps_indices(primitive, *found->second);
                primitive["attributes"] = attributes_to_carry(primitive, *found->second);
                if (!keeps) primitive.erase("indices");
                if (!found->second->split.is_unchanged) continue;
            }
            add_all_accessors(primitive, kept);
        }
    return kept;
}

/// The vertex numbers as bytes, in the smallest type that holds them.
int add_indices(GltfEdit& edit, int replaced, const SplitVertices& split) {
    // The largest number of each type is not an index: it restarts strips.
    const size_t size = split.source.size() > 65534 ? sizeof(uint32_t) : sizeof(uint16_t);
    std::vector<uint8_t> bytes;
    bytes.reserve(split.triangles.size() * 3 * size);
    for (const Triangle& triangle : split.triangles)
        for (const uint32_t vertex : triangle)
            for (size_t i = 0; i < size; ++i) bytes.push_back(static_cast<uint8_t>(vertex >> (8 * i)));
    Json description = replaced < 0 ? Json::object() : edit.source_accessor(replaced);
    for (const char* key : {"min", "max", "normalized"}) description.erase(key);
    description["componentType"] = size == sizeof(uint16_t) ? 5123 : 5125;
    description["type"] = "SCALAR";
    return edit.add_accessor(replaced, std::move(description), std::move(bytes), ViewTarget::indices);
}

int add_uv(GltfEdit& edit, int replaced, const std::vector<Vec2f>& uv) {
    static_assert(sizeof(Vec2f) == 8);
    std::vector<uint8_t> bytes(uv.size() * sizeof(Vec2f));
    std::memcpy(bytes.data(), uv.data(), bytes.size());
    const Json description{{"componentType", 5126}, {"type", "VEC2"}};
    return edit.add_accessor(replaced, description, std::move(bytes), ViewTarget::vertices);
}

void rewrite_primitive(GltfEdit& edit, const Placement& placement) {
    Json primitive = primitive_of(edit.json(), placement);
    std::map<int, int> gathered;
    const auto gather = [&](const Json& accessor) {
        const int old = accessor.get<int>();
        if (placement.split.is_unchanged) return old;
        const auto [entry, is_new] = gathered.try_emplace(old, -1);
        if (is_new) entry->second = edit.add_gathered(old, placement.split.source);
        return entry->second;
    };
    const int old_uv = primitive["attributes"].value("TEXCOORD_1", -1);
    const int old_indices = primitive.value("indices", -1);
    Json attributes = attributes_to_carry(primitive, placement);
    for (Json& accessor : attributes) accessor = gather(accessor);
    if (primitive.contains("targets"))
        for (Json& target : primitive["targets"])
            for (Json& accessor : target) accessor = gather(accessor);
    attributes["TEXCOORD_1"] = add_uv(edit, old_uv, placement.split.uv);
    // Sets are counted from 0 without gaps (glTF 2.0, 3.7.2.1).
    if (!attributes.contains("TEXCOORD_0")) attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"];
    if (!keeps_indices(primitive, placement)) primitive["indices"] = add_indices(edit, old_indices, placement.split);
    primitive["attributes"] = std::move(attributes);
    if (primitive.contains("mode")) primitive["mode"] = mode_triangles;
    primitive_of(edit.json(), placement) = std::move(primitive);
}

/// min and max of every accessor that has or needs them: decoding may have moved values, and files may be
/// wrong.
void correct_all_bounds(GltfEdit& edit) {
    std::set<int> positions;
    for (const Json& mesh : list_of(edit.json(), "meshes"))
        for (const Json& primitive : mesh.at("primitives"))
            positions.insert(primitive["attributes"].value("POSITION", -1));
    for (size_t a = 0; a < edit.accessor_count(); ++a) {
        const Json& accessor = edit.json()["accessors"][a];
        const bool has_bounds = accessor.contains("min") || accessor.contains("max");
        if (has_bounds || positions.count(static_cast<int>(a)) > 0) edit.correct_bounds(static_cast<int>(a));
    }
}

/// The page that each placement's materials refer to: that of receivers, and of all where only pages are marked.
MaterialNeeds material_needs(const Scene& scene, const std::vector<Placement>& placements, bool is_map, int pages) {
    MaterialNeeds needs;
    for (const Placement& placement : placements) {
        const bool refers = is_map ? scene.surfaces[placement.surface].monitor < 0 : pages > 1;
        needs[{placement.mesh, placement.primitive}] = {refers ? placement.page : -1, placement.moved_set};
    }
    return needs;
}

/// Embeds the maps of the pages that materials need. `free_textures` are places for them.
MapReference add_map(GltfEdit& edit, const std::string& name, const MaterialNeeds& needs, const CarriedMap& map,
                     const std::vector<int>& free_textures) {
    MapReference reference;
    reference.channels = Json::array();
    // Unused ones are empty, not null: Blender turns a list that holds null into a text, and the map is lost.
    for (const std::string& monitor : map.channels) reference.channels.push_back(monitor);
    for (size_t p = 0; p < map.pngs.size(); ++p) {
        const std::string page_name = map.pngs.size() > 1 ? name + "." + std::to_string(p) : name;
        PageReference& page = reference.pages.emplace_back();
        page.file = page_name + ".png";
        const bool is_needed = std::any_of(needs.begin(), needs.end(),
                                           [&](const auto& need) { return need.second.page == static_cast<int>(p); });
        const int replaced = p < free_textures.size() ? free_textures[p] : -1;
        if (is_needed) page.texture = add_map_texture(edit, map.pngs[p], page_name, replaced);
    }
    return reference;
}

}  // namespace

std::vector<uint8_t> make_baked_glb(const Scene& scene, const Atlas& atlas, const CarriedMap& map) try {
    GltfEdit edit(scene.path);
    const std::vector<int> free_textures = remove_carried_map(edit, map.pngs.size());
    std::vector<Placement> placements = place_meshes(edit.json(), scene, atlas);
    for (Placement& placement : placements)
        plan_split(edit, primitive_of(edit.json(), placement), scene.surfaces[placement.surface],
                   atlas.surfaces[placement.surface], placement);
    edit.release_accessors(kept_accessors(edit.json(), placements));
    for (const Placement& placement : placements)
        if (!placement.is_in_place) rewrite_primitive(edit, placement);
    correct_all_bounds(edit);
    const MaterialNeeds needs = material_needs(scene, placements, !map.pngs.empty(), atlas.pages);
    MapReference reference = add_map(edit, scene.path.stem().string() + ".visibility", needs, map, free_textures);
    reference.pages.resize(static_cast<size_t>(atlas.pages));
    assign_materials(edit, needs, reference);
    if (!map.pngs.empty()) mark_monitors(edit, scene);
    return edit.to_glb();
} catch (const Json::exception& problem) {
    throw Error(ErrorKind::scene, scene.path.string() + ": the file is not the one that was read (" + problem.what() +
                                      "); run the bake again");
}

}  // namespace surimi
