// SPDX-License-Identifier: Apache-2.0
#include "baker/write/gltf_edit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "baker/write/elements.h"
#include "baker/write/glb_container.h"
#include "baker/write/plain_gltf.h"

namespace surimi {
namespace {

/// The numbers that an extension holds, at any depth: each may be an index into anything.
void collect_numbers(const Json& value, std::set<int64_t>& numbers) {
    if (value.is_number_integer()) numbers.insert(value.get<int64_t>());
    if (value.is_structured())
        for (const Json& item : value) collect_numbers(item, numbers);
}

/// Extensions whose content is known to name neither accessors nor buffer views.
bool is_known_extension(const std::string& name) {
    constexpr std::array prefixes{"KHR_materials_",        "KHR_texture_", "EXT_texture_",
                                  "KHR_lights_",           "EXT_lights_",  "KHR_mesh_quantization",
                                  "KHR_animation_pointer", "KHR_xmp_",     "KHR_node_visibility",
                                  "MSFT_texture_dds",      "MOZ_lightmap"};
    return std::any_of(prefixes.begin(), prefixes.end(), [&](const char* prefix) { return name.starts_with(prefix); });
}

void collect_foreign_numbers(const Json& value, std::set<int64_t>& numbers) {
    if (!value.is_structured()) return;
    for (const auto& [key, item] : value.items()) {
        if (key == "extras") continue;
        if (key == "extensions" && item.is_object()) {
            for (const auto& [name, extension] : item.items())
                if (!is_known_extension(name)) collect_numbers(extension, numbers);
        }
        collect_foreign_numbers(item, numbers);
    }
}

/// Adds the views that an accessor reads.
void collect_views(const Json& accessor, std::set<int>& views) {
    if (accessor.contains("bufferView")) views.insert(accessor["bufferView"].get<int>());
    if (!accessor.contains("sparse")) return;
    views.insert(accessor["sparse"]["indices"]["bufferView"].get<int>());
    views.insert(accessor["sparse"]["values"]["bufferView"].get<int>());
}

}  // namespace

int index_of(const Json& object, const std::string& key, size_t size) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number_integer()) return -1;
    const auto index = found->get<int64_t>();
    return index >= 0 && static_cast<uint64_t>(index) < size ? static_cast<int>(index) : -1;
}

const Json& list_of(const Json& object, const std::string& key) {
    static const Json empty = Json::array();
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : empty;
}

const Json* extension_of(const Json& object, const std::string& name) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return nullptr;
    const auto found = extensions->find(name);
    return found == extensions->end() ? nullptr : &*found;
}

void erase_extension(Json& object, const std::string& name) {
    if (extension_of(object, name) == nullptr) return;
    object["extensions"].erase(name);
    if (object["extensions"].empty()) object.erase("extensions");
}

void declare_extension(Json& document, const std::string& name, bool is_used) {
    const bool is_listed = [&] {
        const Json& used = list_of(document, "extensionsUsed");
        return std::find(used.begin(), used.end(), name) != used.end();
    }();
    if (is_used && !is_listed) document["extensionsUsed"].push_back(name);
    if (is_used) return;
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        Json kept = Json::array();
        for (const Json& other : list_of(document, key))
            if (other != name) kept.push_back(other);
        document[key] = kept;
        if (kept.empty()) document.erase(key);
    }
}

GltfEdit::GltfEdit(const std::filesystem::path& path) {
    PlainGltf plain = load_plain_gltf(path);
    json_ = std::move(plain.json);
    for (auto& bytes : plain.views) {
        storage_.push_back(std::move(bytes));
        views_.emplace_back(storage_.back());
    }
    source_ = {{"accessors", list_of(json_, "accessors")}, {"bufferViews", list_of(json_, "bufferViews")}};
    source_views_ = views_;
    collect_foreign_numbers(json_, foreign_numbers_);
}

const Json& GltfEdit::source_accessor(int accessor) const {
    return source_.at("accessors").at(static_cast<size_t>(accessor));
}

std::vector<uint32_t> GltfEdit::source_indices(int accessor) const {
    return whole_numbers(source_accessor(accessor), elements_of(source_, source_views_, accessor));
}

void GltfEdit::release_accessors(const std::set<int>& kept) {
    std::set<int> needed = kept;
    for (const Json& animation : list_of(json_, "animations"))
        for (const Json& sampler : list_of(animation, "samplers")) {
            needed.insert(sampler.at("input").get<int>());
            needed.insert(sampler.at("output").get<int>());
        }
    for (const Json& skin : list_of(json_, "skins")) needed.insert(skin.value("inverseBindMatrices", -1));
    std::set<int> used_by_meshes;
    for (const Json& mesh : list_of(json_, "meshes"))
        for (const Json& primitive : list_of(mesh, "primitives")) {
            for (const Json& accessor : primitive.at("attributes")) used_by_meshes.insert(accessor.get<int>());
            for (const Json& target : list_of(primitive, "targets"))
                for (const Json& accessor : target) used_by_meshes.insert(accessor.get<int>());
            used_by_meshes.insert(primitive.value("indices", -1));
        }
    std::set<int> views_released;
    std::set<int> views_needed;
    for (int a = 0; a < static_cast<int>(accessor_count()); ++a) {
        const Json& accessor = json_["accessors"][static_cast<size_t>(a)];
        const bool is_free = used_by_meshes.count(a) > 0 && needed.count(a) == 0 && !may_be_referenced(a);
        if (is_free) free_accessors_.insert(a);
        collect_views(accessor, is_free ? views_released : views_needed);
    }
    for (const Json& image : list_of(json_, "images")) views_needed.insert(image.value("bufferView", -1));
    for (const int view : views_released)
        if (views_needed.count(view) == 0 && !may_be_referenced(view)) free_views_.insert(view);
}

int GltfEdit::place_accessor(int replaced, Json accessor) {
    if (free_accessors_.erase(replaced) > 0) {
        json_["accessors"][static_cast<size_t>(replaced)] = std::move(accessor);
        return replaced;
    }
    json_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(accessor_count()) - 1;
}

int GltfEdit::add_view(std::vector<uint8_t> bytes, ViewTarget target, size_t stride) {
    Json description{{"buffer", 0}};
    if (target != ViewTarget::none) description["target"] = static_cast<int>(target);
    if (stride > 0) description["byteStride"] = stride;
    storage_.push_back(std::move(bytes));
    if (free_views_.empty()) {
        json_["bufferViews"].push_back(std::move(description));
        views_.emplace_back(storage_.back());
        return static_cast<int>(views_.size()) - 1;
    }
    const int view = *free_views_.begin();
    free_views_.erase(free_views_.begin());
    json_["bufferViews"][static_cast<size_t>(view)] = std::move(description);
    views_[static_cast<size_t>(view)] = storage_.back();
    return view;
}

void GltfEdit::replace_view(int view, std::vector<uint8_t> bytes) {
    storage_.push_back(std::move(bytes));
    views_.at(static_cast<size_t>(view)) = storage_.back();
}

int GltfEdit::add_accessor(int replaced, Json accessor, std::vector<uint8_t> elements, ViewTarget target) {
    const size_t size = element_size(accessor);
    const bool is_padded = target == ViewTarget::vertices && size % 4 != 0;
    const size_t stride = is_padded ? (size + 3) / 4 * 4 : size;
    const size_t count = elements.size() / size;
    if (accessor.contains("min") || accessor.contains("max")) set_bounds(accessor, elements);
    if (is_padded) {
        std::vector<uint8_t> padded(count * stride, 0);
        for (size_t i = 0; i < count; ++i) std::memcpy(&padded[i * stride], &elements[i * size], size);
        elements = std::move(padded);
    }
    accessor["count"] = count;
    accessor["bufferView"] = add_view(std::move(elements), target, is_padded ? stride : 0);
    accessor.erase("byteOffset");
    accessor.erase("sparse");
    return place_accessor(replaced, std::move(accessor));
}

int GltfEdit::add_gathered(int source, std::span<const uint32_t> order) {
    Json description = source_accessor(source);
    if (!description.contains("bufferView") && !description.contains("sparse")) {  // zeros, however many
        description["count"] = order.size();
        return place_accessor(source, std::move(description));
    }
    const size_t size = element_size(description);
    const auto all = elements_of(source_, source_views_, source);
    std::vector<uint8_t> elements(order.size() * size);
    for (size_t i = 0; i < order.size(); ++i) {
        assert((order[i] + size_t{1}) * size <= all.size());  // split_vertices has checked it
        std::memcpy(&elements[i * size], &all[order[i] * size], size);
    }
    return add_accessor(source, std::move(description), std::move(elements), ViewTarget::vertices);
}

void GltfEdit::correct_bounds(int accessor) {
    const auto bytes = elements_of(json_, views_, accessor);
    set_bounds(json_.at("accessors").at(static_cast<size_t>(accessor)), bytes);
}

std::vector<uint8_t> GltfEdit::to_glb() {
    // Places that nothing took: gone where that renumbers nothing, else left as they are.
    while (!views_.empty() && free_views_.erase(static_cast<int>(views_.size()) - 1) > 0) {
        views_.pop_back();
        json_["bufferViews"].erase(views_.size());
    }
    std::vector<uint8_t> binary;
    for (size_t i = 0; i < views_.size(); ++i) {
        binary.resize((binary.size() + 3) / 4 * 4, 0);
        Json& view = json_["bufferViews"][i];
        view["buffer"] = 0;
        view["byteOffset"] = binary.size();
        view["byteLength"] = views_[i].size();
        binary.insert(binary.end(), views_[i].begin(), views_[i].end());
        if (binary.size() > UINT32_MAX) break;  // make_glb tells the user
    }
    Json buffer = list_of(json_, "buffers").empty() ? Json::object() : json_["buffers"][0];
    buffer.erase("uri");
    erase_extension(buffer, "EXT_meshopt_compression");
    erase_extension(buffer, "KHR_meshopt_compression");
    buffer["byteLength"] = binary.size();
    json_["buffers"] = Json::array({buffer});
    for (const char* list : {"buffers", "bufferViews"})
        if (views_.empty()) json_.erase(list);
    // Names that are not UTF-8 are repaired instead of losing the whole file.
    return make_glb(json_.dump(-1, ' ', false, Json::error_handler_t::replace), binary);
}

}  // namespace surimi
