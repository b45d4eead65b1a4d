// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf_check.h"

#include "runtime/scene/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace surimi {
namespace {

using nlohmann::json;

enum class Kind { index, index_list, whole, number, numbers, boolean, text, object, objects };

struct Member {
    const char* name;
    Kind kind;
    bool is_required = false;
    const char* target = nullptr;  ///< index, index_list: the array of the document that is meant
    size_t length = 0;             ///< numbers: how many; 0: any
};

constexpr bool required = true;

constexpr std::array buffer_members{Member{"byteLength", Kind::whole, required}, Member{"uri", Kind::text}};
constexpr std::array view_members{Member{"buffer", Kind::index, required, "buffers"}, Member{"byteOffset", Kind::whole},
                                  Member{"byteLength", Kind::whole, required}, Member{"byteStride", Kind::whole},
                                  Member{"target", Kind::whole}};
constexpr std::array accessor_members{Member{"bufferView", Kind::index, false, "bufferViews"},
                                      Member{"byteOffset", Kind::whole},
                                      Member{"componentType", Kind::whole, required},
                                      Member{"count", Kind::whole, required},
                                      Member{"type", Kind::text, required},
                                      Member{"normalized", Kind::boolean},
                                      Member{"min", Kind::numbers},
                                      Member{"max", Kind::numbers},
                                      Member{"sparse", Kind::object}};
constexpr std::array sparse_members{Member{"count", Kind::whole, required}, Member{"indices", Kind::object, required},
                                    Member{"values", Kind::object, required}};
constexpr std::array sparse_index_members{Member{"bufferView", Kind::index, required, "bufferViews"},
                                          Member{"byteOffset", Kind::whole},
                                          Member{"componentType", Kind::whole, required}};
constexpr std::array sparse_value_members{Member{"bufferView", Kind::index, required, "bufferViews"},
                                          Member{"byteOffset", Kind::whole}};
constexpr std::array mesh_members{Member{"primitives", Kind::objects, required}, Member{"weights", Kind::numbers}};
constexpr std::array primitive_members{
    Member{"attributes", Kind::object, required}, Member{"indices", Kind::index, false, "accessors"},
    Member{"material", Kind::index, false, "materials"}, Member{"mode", Kind::whole}, Member{"targets", Kind::objects}};
constexpr std::array node_members{Member{"mesh", Kind::index, false, "meshes"},
                                  Member{"skin", Kind::index, false, "skins"},
                                  Member{"camera", Kind::index, false, "cameras"},
                                  Member{"children", Kind::index_list, false, "nodes"},
                                  Member{"matrix", Kind::numbers, false, nullptr, 16},
                                  Member{"rotation", Kind::numbers, false, nullptr, 4},
                                  Member{"scale", Kind::numbers, false, nullptr, 3},
                                  Member{"translation", Kind::numbers, false, nullptr, 3},
                                  Member{"weights", Kind::numbers}};
constexpr std::array scene_members{Member{"nodes", Kind::index_list, false, "nodes"}};
constexpr std::array material_members{Member{"pbrMetallicRoughness", Kind::object},
                                      Member{"normalTexture", Kind::object},
                                      Member{"occlusionTexture", Kind::object},
                                      Member{"emissiveTexture", Kind::object},
                                      Member{"emissiveFactor", Kind::numbers, false, nullptr, 3},
                                      Member{"alphaMode", Kind::text},
                                      Member{"alphaCutoff", Kind::number},
                                      Member{"doubleSided", Kind::boolean}};
constexpr std::array pbr_members{Member{"baseColorFactor", Kind::numbers, false, nullptr, 4},
                                 Member{"metallicFactor", Kind::number}, Member{"roughnessFactor", Kind::number},
                                 Member{"baseColorTexture", Kind::object},
                                 Member{"metallicRoughnessTexture", Kind::object}};
constexpr std::array texture_use_members{Member{"index", Kind::index, required, "textures"},
                                         Member{"texCoord", Kind::whole}, Member{"scale", Kind::number},
                                         Member{"strength", Kind::number}};
constexpr std::array texture_members{Member{"source", Kind::index, false, "images"},
                                     Member{"sampler", Kind::index, false, "samplers"}};
constexpr std::array sampler_members{Member{"wrapS", Kind::whole}, Member{"wrapT", Kind::whole},
                                     Member{"minFilter", Kind::whole}, Member{"magFilter", Kind::whole}};
constexpr std::array image_members{Member{"uri", Kind::text}, Member{"mimeType", Kind::text},
                                   Member{"bufferView", Kind::index, false, "bufferViews"}};
constexpr std::array skin_members{Member{"joints", Kind::index_list, required, "nodes"},
                                  Member{"inverseBindMatrices", Kind::index, false, "accessors"},
                                  Member{"skeleton", Kind::index, false, "nodes"}};
constexpr std::array camera_members{Member{"type", Kind::text, required}, Member{"perspective", Kind::object},
                                    Member{"orthographic", Kind::object}};
constexpr std::array perspective_members{Member{"yfov", Kind::number}, Member{"aspectRatio", Kind::number},
                                         Member{"znear", Kind::number}, Member{"zfar", Kind::number}};
constexpr std::array animation_members{Member{"channels", Kind::objects, required},
                                       Member{"samplers", Kind::objects, required}};
constexpr std::array animation_sampler_members{Member{"input", Kind::index, required, "accessors"},
                                               Member{"output", Kind::index, required, "accessors"},
                                               Member{"interpolation", Kind::text}};
constexpr std::array channel_members{Member{"sampler", Kind::whole, required},
                                     Member{"target", Kind::object, required}};
constexpr std::array target_members{Member{"node", Kind::index, false, "nodes"}, Member{"path", Kind::text, required}};

struct Table {
    const char* array;
    const char* kind;
    std::span<const Member> members;
};

const std::array<Table, 15> tables{{{"buffers", "buffer", buffer_members},
                                    {"bufferViews", "buffer view", view_members},
                                    {"accessors", "accessor", accessor_members},
                                    {"meshes", "mesh", mesh_members},
                                    {"nodes", "node", node_members},
                                    {"scenes", "scene", scene_members},
                                    {"materials", "material", material_members},
                                    {"textures", "texture", texture_members},
                                    {"samplers", "sampler", sampler_members},
                                    {"images", "image", image_members},
                                    {"skins", "skin", skin_members},
                                    {"cameras", "camera", camera_members},
                                    {"animations", "animation", animation_members},
                                    {"extensionsUsed", "extension", {}},
                                    {"extensionsRequired", "extension", {}}}};

/// Extensions that a file may require: they change nothing that we need, or we read them.
bool is_readable_extension(const std::string& name) {
    static const std::set<std::string> readable{"KHR_mesh_quantization",   "KHR_draco_mesh_compression",
                                                "EXT_meshopt_compression", "KHR_meshopt_compression",
                                                "KHR_texture_transform",   "KHR_texture_basisu",
                                                "EXT_texture_webp",        "EXT_texture_avif",
                                                "MSFT_texture_dds",        "KHR_lights_punctual",
                                                "EXT_lights_area",         "EXT_lights_image_based",
                                                "KHR_animation_pointer",   "KHR_xmp_json_ld",
                                                "KHR_node_visibility",     "MOZ_lightmap"};
    return readable.count(name) > 0 || name.rfind("KHR_materials_", 0) == 0;
}

class Checker {
  public:
    Checker(json& root, const std::filesystem::path& path) : root_(root), path_(path) {}

    void check_all() {
        check_root();
        for (const Table& table : tables) {
            if (!root_.contains(table.array) || table.members.empty()) continue;
            json& array = root_[table.array];
            for (size_t i = 0; i < array.size(); ++i) {
                const json& name = array[i].is_object() && array[i].contains("name") ? array[i]["name"] : json();
                place_ = place_name(table.kind, i, name.is_string() ? name.get<std::string>() : "");
                if (!name.is_null() && !name.is_string()) refuse("\"name\" must be text");
                check_members(array[i], table.members);
                check_inside(table.array, array[i]);
            }
        }
        check_tree();
    }

  private:
    [[noreturn]] void refuse(const std::string& what) const { fail(path_, place_, what); }

    void check_root() {
        place_ = "document";
        if (!root_.is_object()) refuse("the JSON is not an object");
        for (const Table& table : tables)
            if (root_.contains(table.array) && !root_[table.array].is_array())
                refuse("\"" + std::string(table.array) + "\" must be a list");
        const Member scene{"scene", Kind::index, false, "scenes"};
        check_members(root_, {&scene, 1});
        place_ = "asset";
        const Member asset{"asset", Kind::object, required};
        check_members(root_, {&asset, 1});
        const Member version{"version", Kind::text, required};
        check_members(root_["asset"], {&version, 1});
        if (root_["asset"]["version"].get<std::string>().rfind("2.", 0) != 0)
            refuse("only glTF 2 is supported; convert the file: npx gltf-pipeline -i in.gltf -o out.glb");
        check_extensions();
    }

    void check_extensions() {
        place_ = "extensionsUsed";
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            for (const json& name : root_.value(list, json::array()))
                if (!name.is_string()) refuse("extension names must be text");
        place_ = "extensionsRequired";
        for (const json& name : root_.value("extensionsRequired", json::array())) {
            const std::string text = name.get<std::string>();
            if (is_readable_extension(text)) continue;
            const bool is_instancing = text == "EXT_mesh_gpu_instancing";
            refuse("the file requires the extension " + text + ", which Surimi cannot read; convert the file: " +
                   (is_instancing ? "npx @gltf-transform/cli uninstance in.glb out.glb"
                                  : "npx @gltf-transform/cli copy in.glb out.glb"));
        }
    }

    void check_members(json& object, std::span<const Member> members) {
        if (!object.is_object()) refuse("must be an object");
        for (const Member& member : members) {
            const auto found = object.find(member.name);
            if (found != object.end()) {
                check_member(*found, member);
            } else if (member.is_required) {
                refuse("\"" + std::string(member.name) + "\" is missing");
            }
        }
    }

    void check_member(json& value, const Member& member) {
        const std::string name = "\"" + std::string(member.name) + "\"";
        switch (member.kind) {
            case Kind::index:
                check_index(value, member);
                break;
            case Kind::index_list:
                if (!value.is_array()) refuse(name + " must be a list");
                for (json& item : value) check_index(item, member);
                break;
            case Kind::whole:
                check_whole(value, name);
                break;
            case Kind::number:
                if (!value.is_number()) refuse(name + " must be a number");
                break;
            case Kind::numbers:
                if (!value.is_array() ||
                    !std::all_of(value.begin(), value.end(), [](const json& n) { return n.is_number(); }))
                    refuse(name + " must be a list of numbers");
                if (member.length > 0 && value.size() != member.length)
                    refuse(name + " must have " + std::to_string(member.length) + " numbers");
                break;
            case Kind::boolean:
                if (!value.is_boolean()) refuse(name + " must be true or false");
                break;
            case Kind::text:
                if (!value.is_string()) refuse(name + " must be text");
                break;
            case Kind::object:
                if (!value.is_object()) refuse(name + " must be an object");
                break;
            case Kind::objects:
                if (!value.is_array() ||
                    !std::all_of(value.begin(), value.end(), [](const json& o) { return o.is_object(); }))
                    refuse(name + " must be a list of objects");
                break;
        }
    }

    /// Non-negative and below 2^53, where doubles stop being exact.
    uint64_t check_whole(json& value, const std::string& name) {
        constexpr double limit = 9007199254740992.0;
        const double number = value.is_number() ? value.get<double>() : -1;
        if (!(number >= 0 && number < limit && number == std::floor(number)))
            refuse(name + " must be a whole number, zero or more");
        value = static_cast<uint64_t>(number);
        return value.get<uint64_t>();
    }

    void check_index(json& value, const Member& member) {
        const std::string name = "\"" + std::string(member.name) + "\"";
        const uint64_t index = check_whole(value, name);
        const auto target = root_.find(member.target);
        const size_t size = target == root_.end() ? 0 : target->size();
        if (index >= size || index > static_cast<uint64_t>(std::numeric_limits<int>::max()))
            refuse(name + " is " + std::to_string(index) + ", but the file has " + std::to_string(size) + " " +
                   member.target);
    }

    void check_texture_uses(json& object, std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (object.contains(name)) check_members(object[name], texture_use_members);
    }

    void check_accessor_map(json& map, const char* name) {
        const Member member{name, Kind::index, false, "accessors"};
        for (auto& item : map.items()) check_index(item.value(), member);
    }

    void check_inside(const std::string& array, json& object) {
        if (array == "accessors") check_accessor(object);
        if (array == "meshes") check_mesh(object);
        if (array == "materials") {
            check_texture_uses(object, {"normalTexture", "occlusionTexture", "emissiveTexture"});
            if (!object.contains("pbrMetallicRoughness")) return;
            check_members(object["pbrMetallicRoughness"], pbr_members);
            check_texture_uses(object["pbrMetallicRoughness"], {"baseColorTexture", "metallicRoughnessTexture"});
        }
        if (array == "cameras" && object.contains("perspective"))
            check_members(object["perspective"], perspective_members);
        if (array == "animations") check_animation(object);
    }

    void check_accessor(json& accessor) {
        static const std::set<std::string> types{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
        if (types.count(accessor["type"].get<std::string>()) == 0)
            refuse("\"type\" is " + accessor["type"].dump() + ", which glTF does not know");
        check_component_type(accessor);
        if (!accessor.contains("sparse")) return;
        json& sparse = accessor["sparse"];
        check_members(sparse, sparse_members);
        check_members(sparse["indices"], sparse_index_members);
        check_members(sparse["values"], sparse_value_members);
        check_component_type(sparse["indices"]);
        // tinygltf keeps these as int; a sparse part beyond 2 GB is a broken file.
        const uint64_t limit = static_cast<uint64_t>(std::numeric_limits<int>::max());
        for (const uint64_t number :
             {sparse["count"].get<uint64_t>(), sparse["indices"].value("byteOffset", uint64_t{0}),
              sparse["values"].value("byteOffset", uint64_t{0})})
            if (number > limit) refuse("the sparse part is larger than 2 GB");
    }

    void check_component_type(const json& object) {
        const uint64_t type = object["componentType"].get<uint64_t>();
        if (type < 5120 || type > 5126 || type == 5124)
            refuse("\"componentType\" is " + std::to_string(type) + ", which glTF does not know");
    }

    void check_mesh(json& mesh) {
        const std::string place = place_;
        json& primitives = mesh["primitives"];
        for (size_t p = 0; p < primitives.size(); ++p) {
            place_ = place + ", primitive " + std::to_string(p);
            check_members(primitives[p], primitive_members);
            check_accessor_map(primitives[p]["attributes"], "attributes");
            if (primitives[p].contains("targets"))
                for (json& target : primitives[p]["targets"]) check_accessor_map(target, "targets");
            const uint64_t mode = primitives[p].value("mode", uint64_t{4});
            if (mode > 6) refuse("\"mode\" is " + std::to_string(mode) + ", which glTF does not know");
        }
    }

    void check_animation(json& animation) {
        for (json& sampler : animation["samplers"]) check_members(sampler, animation_sampler_members);
        for (json& channel : animation["channels"]) {
            check_members(channel, channel_members);
            check_members(channel["target"], target_members);
            if (channel["sampler"].get<uint64_t>() >= animation["samplers"].size())
                refuse("a channel names no sampler");
        }
    }

    /// Nodes with at most one parent form a forest exactly when all of them can be reached from nodes without
    /// one.
    void check_tree() {
        const json nodes = root_.value("nodes", json::array());
        std::vector<int64_t> parent(nodes.size(), -1);
        for (size_t i = 0; i < nodes.size(); ++i)
            for (const json& child : nodes[i].value("children", json::array())) {
                const size_t c = child.get<size_t>();
                place_ = place_name("node", c, nodes[c].value("name", ""));
                if (parent[c] >= 0)
                    refuse("is a child of node " + std::to_string(parent[c]) + " and of node " + std::to_string(i));
                parent[c] = static_cast<int64_t>(i);
            }
        std::vector<size_t> reached;
        for (size_t i = 0; i < nodes.size(); ++i)
            if (parent[i] < 0) reached.push_back(i);
        std::vector<bool> is_reached(nodes.size(), false);
        for (size_t i = 0; i < reached.size(); ++i) {
            is_reached[reached[i]] = true;
            for (const json& child : nodes[reached[i]].value("children", json::array()))
                reached.push_back(child.get<size_t>());
        }
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (is_reached[i]) continue;
            place_ = place_name("node", i, nodes[i].value("name", ""));
            refuse("is its own ancestor (a loop in the node tree)");
        }
    }

    json& root_;
    std::filesystem::path path_;
    std::string place_;
};

}  // namespace

void check_json(json& json_document, const std::filesystem::path& path) {
    Checker(json_document, path).check_all();
}

}  // namespace surimi
