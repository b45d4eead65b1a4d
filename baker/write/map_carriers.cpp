// SPDX-License-Identifier: Apache-2.0
#include "baker/write/map_carriers.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace surimi {
namespace {

constexpr const char* clearcoat = "KHR_materials_clearcoat";
constexpr const char* sheen = "KHR_materials_sheen";
constexpr const char* mark = "visibilityMap";
constexpr const char* transform = "KHR_texture_transform";

/// The set that a texture use reads; KHR_texture_transform has the last word.
int set_of(const Json& use) {
    constexpr size_t any = 1000;  // far more sets than a vertex can have
    const int own = std::max(index_of(use, "texCoord", any), 0);
    const Json* extension = extension_of(use, transform);
    const int overriding = extension != nullptr && extension->is_object() ? index_of(*extension, "texCoord", any) : -1;
    return overriding >= 0 ? overriding : own;
}

void move_set(Json& material, int from, int to) {
    for_each_texture_use(material, [&](Json& use) {
        if (set_of(use) != from) return;
        use["texCoord"] = to;
        const Json* extension = extension_of(use, transform);
        if (extension != nullptr && extension->contains("texCoord")) use["extensions"][transform]["texCoord"] = to;
    });
}

bool material_reads_set(const Json& material, int set) {
    bool reads = false;
    for_each_texture_use(material, [&](const Json& use) { reads = reads || set_of(use) == set; });
    return reads;
}

/// Calls visit(reference) for "material" of the primitive and of its variants.
template <class AnyJson, class Visit>
void for_each_material(AnyJson& primitive, const Visit& visit) {
    if (primitive.contains("material")) visit(primitive["material"]);
    if (extension_of(primitive, "KHR_materials_variants") == nullptr) return;
    auto& variants = primitive["extensions"]["KHR_materials_variants"];
    if (!variants.is_object() || !variants.contains("mappings")) return;
    for (auto& mapping : variants["mappings"])
        if (mapping.is_object() && mapping.contains("material") && mapping["material"].is_number_integer())
            visit(mapping["material"]);
}

bool is_black(const Json& factor) {
    return factor.is_array() && std::all_of(factor.begin(), factor.end(), [](const Json& f) { return f == 0; });
}

/// Removes what carry_map added to a material; adds its texture to `textures`.
void take_off_map(Json& material, std::set<int>& textures) {
    if (!material.contains("extras") || !material["extras"].is_object()) return;
    if (!material["extras"].contains(mark)) return;
    const Json note = std::move(material["extras"][mark]);
    material["extras"].erase(mark);
    if (material["extras"].empty()) material.erase("extras");
    // Blender made a text of the marks of version 0.1.0 that had unused channels; else the page alone was marked.
    const bool had_map = note.is_string() || (note.is_object() && note.contains("channels"));
    if (!had_map) return;
    const auto take_off = [&](const char* extension, const char* texture, bool is_off) {
        if (!is_off) return;
        textures.insert(index_of(material["extensions"][extension].value(texture, Json::object()), "index", INT32_MAX));
        erase_extension(material, extension);
    };
    const Json* coat = extension_of(material, clearcoat);
    if (coat != nullptr && coat->is_object())
        take_off(clearcoat, "clearcoatTexture", coat->value("clearcoatFactor", Json(0)) == 0);
    const Json* cloth = extension_of(material, sheen);
    if (cloth != nullptr && cloth->is_object())
        take_off(sheen, "sheenColorTexture", is_black(cloth->value("sheenColorFactor", Json::array())));
}

void carry_map(Json& material, const MapReference& map, int number) {
    const PageReference& page = map.pages[static_cast<size_t>(number)];
    const bool has_room = !material.contains("extensions") || material["extensions"].is_object();
    // Neither may be combined with layers, their specifications say.
    const bool is_layered = has_room && extension_of(material, "KHR_materials_unlit") == nullptr &&
                            extension_of(material, "KHR_materials_pbrSpecularGlossiness") == nullptr;
    const Json use{{"index", page.texture}, {"texCoord", 1}};
    Json note{{"version", 1}};
    if (page.texture >= 0) note.update({{"encoding", "srgb"}, {"channels", map.channels}});
    if (map.pages.size() > 1) note["page"] = number;
    if (page.texture < 0) {
        note["texCoord"] = 1;
    } else if (is_layered && extension_of(material, clearcoat) == nullptr) {
        material["extensions"][clearcoat] = {{"clearcoatFactor", 0}, {"clearcoatTexture", use}};
    } else if (is_layered && extension_of(material, sheen) == nullptr) {
        material["extensions"][sheen] = {{"sheenColorFactor", {0, 0, 0}}, {"sheenColorTexture", use}};
    } else {
        note["file"] = page.file;
        note["texCoord"] = 1;
    }
    if (!material.contains("extras") || material["extras"].is_object()) material["extras"][mark] = std::move(note);
}

/// Hands out materials by what is asked of them, copying as few as possible.
class MaterialCopies {
  public:
    MaterialCopies(GltfEdit& edit, const MapReference& map)
        : materials_(edit.json()["materials"]), map_(map), originals_(materials_) {
        if (materials_.is_null()) materials_ = Json::array();
    }

    /// The material is used as it is by someone, so that its place is taken.
    void keep(int material) { taken_.insert(material); }

    bool is_needed_as_it_is(int material, const MaterialNeed& need) const {
        return need.page < 0 && (need.moved_set == 0 || !material_reads_set(original(material), 1));
    }

    /// `material` -1: glTF's default.
    int get(int material, const MaterialNeed& need) {
        const bool is_nothing = material >= static_cast<int>(originals_.size());
        if (is_nothing || is_needed_as_it_is(material, need)) return material;
        const int moved_set = material_reads_set(original(material), 1) ? need.moved_set : 0;
        const auto [entry, is_new] = copies_.try_emplace({material, need.page, moved_set}, material);
        if (!is_new) return entry->second;
        Json copy = original(material);
        if (moved_set > 0) move_set(copy, 1, moved_set);
        if (need.page >= 0) carry_map(copy, map_, need.page);
        if (material < 0 || !taken_.insert(material).second) {
            entry->second = static_cast<int>(materials_.size());
            materials_.push_back(std::move(copy));
        } else {
            materials_[static_cast<size_t>(material)] = std::move(copy);
        }
        return entry->second;
    }

  private:
    Json original(int material) const {
        const bool exists = material >= 0 && static_cast<size_t>(material) < originals_.size();
        return exists ? originals_[static_cast<size_t>(material)] : Json::object();
    }

    Json& materials_;
    const MapReference& map_;
    Json originals_;
    std::map<std::tuple<int, int, int>, int> copies_;  // of material, page and moved set
    std::set<int> taken_;
};

bool is_used_by_any_material(const Json& document, const char* extension) {
    const Json& materials = list_of(document, "materials");
    return std::any_of(materials.begin(), materials.end(),
                       [&](const Json& material) { return extension_of(material, extension) != nullptr; });
}

int find_or_add(Json& list, Json item) {
    const auto found = std::find(list.begin(), list.end(), item);
    if (found != list.end()) return static_cast<int>(found - list.begin());
    list.push_back(std::move(item));
    return static_cast<int>(list.size()) - 1;
}

/// The image of `texture` if no other texture shows it and nobody else reads its view; -1 otherwise.
int own_image(const GltfEdit& edit, int texture) {
    const Json& document = edit.json();
    const Json& textures = list_of(document, "textures");
    const Json& images = list_of(document, "images");
    if (texture < 0) return -1;
    const int image = index_of(textures[static_cast<size_t>(texture)], "source", images.size());
    if (image < 0 || edit.may_be_referenced(image)) return -1;
    const Json view = images[static_cast<size_t>(image)].value("bufferView", Json());
    const auto shows = [&](const Json& other) { return other.value("source", -1) == image; };
    const auto reads = [&](const Json& other) { return other.value("bufferView", Json()) == view; };
    const Json& accessors = list_of(document, "accessors");
    const bool is_own = view.is_number() && std::count_if(textures.begin(), textures.end(), shows) == 1 &&
                        std::count_if(images.begin(), images.end(), reads) == 1 &&
                        std::none_of(accessors.begin(), accessors.end(), reads);
    return is_own ? image : -1;
}

/// Removes an unused texture and its own image if they are the last of their lists.
void drop_last_texture(GltfEdit& edit, int texture) {
    Json& document = edit.json();
    const int image = own_image(edit, texture);
    const auto is_last = [&](int index, const char* list) {
        return index >= 0 && static_cast<size_t>(index) + 1 == list_of(document, list).size();
    };
    if (!is_last(texture, "textures") || !is_last(image, "images")) return;
    edit.release_view(document["images"].back()["bufferView"].get<int>());
    for (const char* list : {"textures", "images"}) {
        document[list].erase(document[list].size() - 1);
        if (document[list].empty()) document.erase(list);
    }
}

}  // namespace

bool reads_set(const Json& document, const Json& primitive, int set) {
    const Json& materials = list_of(document, "materials");
    bool reads = false;
    for_each_material(primitive, [&](const Json& material) {
        if (material < materials.size()) reads = reads || material_reads_set(materials.at(material.get<size_t>()), set);
    });
    return reads;
}

std::vector<int> remove_carried_map(GltfEdit& edit, size_t page_count) {
    Json& document = edit.json();
    std::set<int> textures;
    if (!document.contains("materials")) return {};
    for (Json& material : document["materials"]) take_off_map(material, textures);
    for (const char* extension : {clearcoat, sheen})
        if (!textures.empty() && !is_used_by_any_material(document, extension))
            declare_extension(document, extension, false);
    for (const Json& material : document["materials"])
        for_each_texture_use(material, [&](const Json& use) { textures.erase(index_of(use, "index", INT32_MAX)); });
    std::vector<int> unused;
    for (const int texture : textures) {
        const bool exists = texture >= 0 && static_cast<size_t>(texture) < list_of(document, "textures").size();
        if (exists && !edit.may_be_referenced(texture)) unused.push_back(texture);
    }
    for (; unused.size() > page_count; unused.pop_back()) drop_last_texture(edit, unused.back());
    return unused;
}

int add_map_texture(GltfEdit& edit, std::span<const uint8_t> png, const std::string& name, int replaced) {
    Json& document = edit.json();
    std::vector<uint8_t> bytes(png.begin(), png.end());
    int image = own_image(edit, replaced);
    if (image >= 0) {
        edit.replace_view(document["images"][static_cast<size_t>(image)]["bufferView"].get<int>(), std::move(bytes));
    } else {
        image = static_cast<int>(list_of(document, "images").size());
        const int view = edit.add_view(std::move(bytes), ViewTarget::none, 0);
        document["images"].push_back({{"bufferView", view}});
    }
    Json& description = document["images"][static_cast<size_t>(image)];
    description["name"] = name;
    description["mimeType"] = "image/png";
    constexpr int linear = 9729;  // no mipmaps: a small level would mix charts across their gutters
    constexpr int clamp = 33071;
    const int sampler = find_or_add(document["samplers"],
                                    {{"magFilter", linear}, {"minFilter", linear}, {"wrapS", clamp}, {"wrapT", clamp}});
    const Json texture{{"name", name}, {"sampler", sampler}, {"source", image}};
    if (replaced < 0) return find_or_add(document["textures"], texture);
    document["textures"][static_cast<size_t>(replaced)] = texture;
    return replaced;
}

void assign_materials(GltfEdit& edit, const MaterialNeeds& needs, const MapReference& map) {
    Json& document = edit.json();
    MaterialCopies copies(edit, map);
    const auto for_each_primitive = [&](const auto& visit) {
        if (!document.contains("meshes")) return;
        for (size_t m = 0; m < document["meshes"].size(); ++m) {
            Json& primitives = document["meshes"][m]["primitives"];
            for (size_t p = 0; p < primitives.size(); ++p) {
                const auto need = needs.find({m, p});
                visit(primitives[p], need == needs.end() ? MaterialNeed{} : need->second);
            }
        }
    };
    // Whoever needs nothing keeps the material's place; only then is it known which places are free for the
    // others.
    for_each_primitive([&](Json& primitive, const MaterialNeed& need) {
        for_each_material(primitive, [&](Json& material) {
            if (copies.is_needed_as_it_is(material.get<int>(), need)) copies.keep(material.get<int>());
        });
    });
    for_each_primitive([&](Json& primitive, const MaterialNeed& need) {
        const bool lacks_material = need.page >= 0 && !primitive.contains("material");
        for_each_material(primitive, [&](Json& material) { material = copies.get(material.get<int>(), need); });
        if (lacks_material) primitive["material"] = copies.get(-1, need);
    });
    if (document["materials"].empty()) document.erase("materials");
    for (const char* extension : {clearcoat, sheen})
        if (is_used_by_any_material(document, extension)) declare_extension(document, extension, true);
}

}  // namespace surimi
