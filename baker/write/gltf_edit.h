// SPDX-License-Identifier: Apache-2.0
// A glTF document under change: its JSON, and the bytes of its buffer views. What nobody touches stays as it
// was.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace surimi {

using Json = nlohmann::json;

/// `object[key]` as an index below `size`; -1 when it is absent or out of range.
int index_of(const Json& object, const std::string& key, size_t size);

/// `object[key]`, or an empty array when it is absent: for loops over optional lists.
const Json& list_of(const Json& object, const std::string& key);

/// `object.extensions[name]`, or null.
const Json* extension_of(const Json& object, const std::string& name);
void erase_extension(Json& object, const std::string& name);

/// Adds `name` to extensionsUsed, or removes it from extensionsUsed and extensionsRequired.
void declare_extension(Json& document, const std::string& name, bool is_used);

/// Calls visit(use) for every object that refers to a texture: "...Texture": {"index": ...}, in the core or
/// in an extension.
template <class AnyJson, class Visit>
void for_each_texture_use(AnyJson& value, const Visit& visit) {
    if (!value.is_object()) return;
    for (auto item = value.begin(); item != value.end(); ++item) {
        if (item.key() == "extras") continue;
        const bool is_use = item.key().ends_with("Texture") && item->is_object() && item->contains("index");
        if (is_use) visit(*item);
        for_each_texture_use(*item, visit);
    }
}

enum class ViewTarget { none = 0, vertices = 34962, indices = 34963 };

class GltfEdit {
  public:
    /// Loads the file with all it refers to. Compressed buffers become plain, images become buffer views.
    explicit GltfEdit(const std::filesystem::path& path);

    Json& json() { return json_; }
    const Json& json() const { return json_; }

    size_t accessor_count() const { return list_of(json_, "accessors").size(); }

    /// An accessor as the file had it, whatever lies in its place now.
    const Json& source_accessor(int accessor) const;

    /// The vertex numbers that an accessor of the file holds.
    std::vector<uint32_t> source_indices(int accessor) const;

    /// Declares that only `kept` accessors, and those that animations, skins and unknown extensions use, are
    /// still needed. The others' places are taken by accessors and views to come, so that no dead data stays
    /// in the file.
    void release_accessors(const std::set<int>& kept);

    /// A copy of an accessor of the file with the elements `order`, in the same format; in its place if that
    /// was released.
    int add_gathered(int source, std::span<const uint32_t> order);

    /// A new accessor with these elements, in the place of `replaced` if that was released (-1: nowhere).
    int add_accessor(int replaced, Json accessor, std::vector<uint8_t> elements, ViewTarget target);

    /// Brings min and max of an accessor in line with its elements.
    void correct_bounds(int accessor);

    int add_view(std::vector<uint8_t> bytes, ViewTarget target, size_t stride);
    void replace_view(int view, std::vector<uint8_t> bytes);

    /// Nothing reads the view any more: its place is free.
    void release_view(int view) { free_views_.insert(view); }

    /// True when an extension that Surimi does not know holds this number, which may be an index.
    bool may_be_referenced(int index) const { return foreign_numbers_.count(index) > 0; }

    /// The file: JSON and one buffer.
    std::vector<uint8_t> to_glb();

  private:
    int place_accessor(int replaced, Json accessor);

    using Views = std::vector<std::span<const uint8_t>>;

    Json json_;
    Views views_;  // bytes of json_["bufferViews"]
    Json source_;  // "accessors" and "bufferViews" of the file
    Views source_views_;
    std::deque<std::vector<uint8_t>> storage_;  // what the views point to; a deque leaves things where they are
    std::set<int> free_accessors_;
    std::set<int> free_views_;
    std::set<int64_t> foreign_numbers_;
};

}  // namespace surimi
