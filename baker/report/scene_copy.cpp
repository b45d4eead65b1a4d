// SPDX-License-Identifier: Apache-2.0
#include "baker/report/scene_copy.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string_view>

#include "baker/report/gzip.h"
#include "baker/write/glb_container.h"
#include "baker/write/gltf_edit.h"
#include "baker/write/plain_gltf.h"
#include "runtime/base/color.h"
#include "runtime/image/image_file.h"

namespace surimi {
namespace {

constexpr const char* clearcoat = "KHR_materials_clearcoat";
constexpr const char* sheen = "KHR_materials_sheen";

bool carries_map(const Json& material) {
    return material.contains("extras") && material["extras"].is_object() &&
           material["extras"].contains("visibilityMap");
}

/// The set of coordinates that the map of a material is read with.
int set_of_map(const Scene& baked, size_t material) {
    return material < baked.materials.size() && baked.materials[material].visibility_map.image >= 0
               ? baked.materials[material].visibility_map.uv_set
               : 1;
}

bool is_texture(const std::string& key, const Json& value) {
    return key.ends_with("Texture") && value.is_object() && value.contains("index");
}

void erase_textures(Json& part) {
    if (!part.is_object()) return;
    std::vector<std::string> keys;
    for (auto& [key, value] : part.items()) {
        if (is_texture(key, value))
            keys.push_back(key);
        else
            erase_textures(value);
    }
    for (const std::string& key : keys) part.erase(key);
}

/// Linear mean of a picture's colour.
Vec3 mean_color(const Image<glm::u8vec4>& image) {
    std::array<double, 256> linear{};
    for (size_t code = 0; code < linear.size(); ++code)
        linear[code] = linear_from_srgb(static_cast<double>(code) / 255);
    Vec3 sum(0);
    for (const glm::u8vec4& pixel : image.pixels) sum += Vec3(linear[pixel.x], linear[pixel.y], linear[pixel.z]);
    return sum / static_cast<double>(std::max<size_t>(image.pixels.size(), 1));
}

/// Takes all textures off a material and gives it the mean of its base colour.
void flatten(Json& material, const Scene& baked, size_t number) {
    erase_textures(material);
    if (material.value("alphaMode", "") == "MASK") material["alphaMode"] = "OPAQUE";
    if (number >= baked.materials.size()) return;
    const int image = baked.materials[number].base_color_texture.image;
    if (image < 0 || baked.images[static_cast<size_t>(image)].empty()) return;
    const Vec4 factor = baked.materials[number].base_color;
    const Vec3 color = Vec3(factor) * mean_color(baked.images[static_cast<size_t>(image)]);
    material["pbrMetallicRoughness"]["baseColorFactor"] = {color.x, color.y, color.z, factor.w};
}

/// Bytes of the images that materials use; none where one has a format that not every browser reads.
std::optional<size_t> texture_bytes(const PlainGltf& gltf) {
    std::set<size_t> images;
    bool is_common = true;
    const Json& textures = list_of(gltf.json, "textures");
    for (const Json& material : list_of(gltf.json, "materials"))
        for_each_texture_use(material, [&](const Json& use) {
            const auto t = static_cast<size_t>(index_of(use, "index", textures.size()));
            const int image =
                t < textures.size() ? index_of(textures[t], "source", list_of(gltf.json, "images").size()) : -1;
            if (image >= 0)
                images.insert(static_cast<size_t>(image));
            else
                is_common = false;
        });
    size_t bytes = 0;
    for (const size_t i : images) {
        const Json& image = gltf.json["images"][i];
        const int view = index_of(image, "bufferView", gltf.views.size());
        const std::string type = image.value("mimeType", "");
        if (view < 0 || (type != "image/png" && type != "image/jpeg")) return {};
        bytes += gltf.views[static_cast<size_t>(view)].size();
    }
    return is_common ? std::optional(bytes) : std::nullopt;
}

/// Gives all materials with the map one white texture in its place: the page has the map already, and hangs it there.
void put_white_map(PlainGltf& gltf, const Scene& baked) {
    Json& json = gltf.json;
    const Image<glm::u8vec3> white(1, 1, glm::u8vec3(255));
    json["bufferViews"].push_back({{"buffer", 0}});
    gltf.views.push_back(encode_png(white));
    json["images"].push_back({{"bufferView", gltf.views.size() - 1}, {"mimeType", "image/png"}});
    json["textures"].push_back({{"source", json["images"].size() - 1}});
    const size_t texture = json["textures"].size() - 1;
    for (size_t m = 0; m < list_of(json, "materials").size(); ++m) {
        Json& material = json["materials"][m];
        if (!carries_map(material)) continue;
        material["extensions"][clearcoat] = {
            {"clearcoatFactor", 0}, {"clearcoatTexture", {{"index", texture}, {"texCoord", set_of_map(baked, m)}}}};
    }
    declare_extension(json, clearcoat, true);
}

/// Takes the map off, wherever it is: on a layer that is switched off, or in another file. A material that uses both
/// layers itself loses its clear coat.
void remove_map(Json& material) {
    if (!carries_map(material)) return;
    const Json* layer = extension_of(material, clearcoat);
    const bool is_on_clearcoat = layer != nullptr && layer->value("clearcoatFactor", 0.0) == 0;
    erase_extension(material, clearcoat);
    if (!is_on_clearcoat) erase_extension(material, sheen);
    if (material["extras"]["visibilityMap"].is_object()) material["extras"]["visibilityMap"].erase("file");
}

void visit_accessors(const Json& json, const std::function<void(const Json&)>& visit) {
    for (const Json& mesh : list_of(json, "meshes"))
        for (const Json& primitive : list_of(mesh, "primitives")) {
            if (primitive.contains("indices")) visit(primitive["indices"]);
            if (primitive.contains("attributes"))
                for (const Json& accessor : primitive["attributes"]) visit(accessor);
            for (const Json& target : list_of(primitive, "targets"))
                for (const Json& accessor : target) visit(accessor);
        }
    for (const Json& skin : list_of(json, "skins"))
        if (skin.contains("inverseBindMatrices")) visit(skin["inverseBindMatrices"]);
    for (const Json& node : list_of(json, "nodes"))
        if (const Json* instances = extension_of(node, "EXT_mesh_gpu_instancing"); instances != nullptr)
            for (const Json& accessor : instances->value("attributes", Json::object())) visit(accessor);
}

/// The views that something still refers to.
std::set<size_t> used_views(const PlainGltf& gltf) {
    std::set<size_t> used;
    const size_t count = gltf.views.size();
    const Json& accessors = list_of(gltf.json, "accessors");
    const auto use = [&](const Json& object) {
        if (const int view = index_of(object, "bufferView", count); view >= 0) used.insert(static_cast<size_t>(view));
    };
    visit_accessors(gltf.json, [&](const Json& index) {
        const int a = index_of({{"i", index}}, "i", accessors.size());
        if (a < 0) return;
        const Json& accessor = accessors[static_cast<size_t>(a)];
        use(accessor);
        if (!accessor.contains("sparse")) return;
        use(accessor["sparse"].value("indices", Json::object()));
        use(accessor["sparse"].value("values", Json::object()));
    });
    const Json& textures = list_of(gltf.json, "textures");
    const Json& images = list_of(gltf.json, "images");
    for (const Json& material : list_of(gltf.json, "materials"))
        for_each_texture_use(material, [&](const Json& texture) {
            const int t = index_of(texture, "index", textures.size());
            const int image = t >= 0 ? index_of(textures[static_cast<size_t>(t)], "source", images.size()) : -1;
            if (image >= 0) use(images[static_cast<size_t>(image)]);
        });
    return used;
}

/// Coordinates that only textures needed which are gone.
void erase_coordinates(Json& json, const Scene& baked) {
    if (!json.contains("meshes")) return;
    for (Json& mesh : json["meshes"])
        for (Json& primitive : mesh["primitives"]) {
            const int material = index_of(primitive, "material", list_of(json, "materials").size());
            const int kept = material >= 0 ? set_of_map(baked, static_cast<size_t>(material)) : 1;
            for (int set = 0; set < 8; ++set)
                if (set != kept) primitive["attributes"].erase("TEXCOORD_" + std::to_string(set));
            primitive["attributes"].erase("TANGENT");
        }
}

/// One buffer of the views that are used; the others keep their numbers, with nothing in them.
std::vector<uint8_t> pack(PlainGltf& gltf) {
    constexpr size_t alignment = 4;
    const std::set<size_t> used = used_views(gltf);
    std::vector<uint8_t> binary(alignment, 0);  // what unused views show
    for (size_t v = 0; v < gltf.views.size(); ++v) {
        Json& view = gltf.json["bufferViews"][v];
        view["buffer"] = 0;
        if (!used.contains(v)) {
            view = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", alignment}};
            continue;
        }
        view["byteOffset"] = binary.size();
        view["byteLength"] = gltf.views[v].size();
        binary.insert(binary.end(), gltf.views[v].begin(), gltf.views[v].end());
        binary.resize((binary.size() + alignment - 1) / alignment * alignment, 0);
    }
    gltf.json["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    return make_glb(gltf.json.dump(-1, ' ', false, Json::error_handler_t::replace), binary);
}

}  // namespace

SceneCopy copy_scene(const std::filesystem::path& glb, const Scene& baked) {
    PlainGltf gltf = load_plain_gltf(glb);
    gltf.json.erase("animations");
    if (gltf.json.contains("materials"))
        for (Json& material : gltf.json["materials"]) remove_map(material);
    SceneCopy copy;
    const std::optional<size_t> textures = texture_bytes(gltf);
    copy.has_textures = textures && *textures <= most_texture_bytes;
    if (!copy.has_textures) {
        for (size_t m = 0; m < list_of(gltf.json, "materials").size(); ++m)
            flatten(gltf.json["materials"][m], baked, m);
        erase_coordinates(gltf.json, baked);
    }
    put_white_map(gltf, baked);
    copy.glb_gzip = gzip(pack(gltf));
    copy.bytes = copy.glb_gzip.size();
    if (copy.bytes > most_scene_bytes) copy.glb_gzip.clear();
    return copy;
}

}  // namespace surimi
