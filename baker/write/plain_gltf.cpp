// SPDX-License-Identifier: Apache-2.0
#include "baker/write/plain_gltf.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "baker/write/gltf_edit.h"
#include "runtime/base/error.h"
#include "runtime/scene/accessor.h"
#include "runtime/scene/gltf_document.h"

namespace surimi {
namespace {

constexpr const char* draco = "KHR_draco_mesh_compression";
constexpr std::array meshopt_names{"EXT_meshopt_compression", "KHR_meshopt_compression"};

std::span<const uint8_t> bytes_of_view(const tinygltf::Model& model, size_t view) {
    const tinygltf::BufferView& description = model.bufferViews.at(view);
    const auto& buffer = model.buffers.at(static_cast<size_t>(description.buffer)).data;
    return std::span<const uint8_t>(buffer).subspan(description.byteOffset, description.byteLength);
}

/// Views may overlap, so that a small file can ask for more than there is: what no .glb could hold is refused
/// early.
void check_total_size(const tinygltf::Model& model, const std::filesystem::path& path) {
    size_t total = 0;
    for (const auto& view : model.bufferViews) total += view.byteLength;
    if (total <= UINT32_MAX) return;
    throw Error(ErrorKind::scene, path.string() + ": its buffer views have " + std::to_string(total) +
                                      " bytes together, but a .glb holds less than 4 GiB; split the scene");
}

void copy_views(const GltfDocument& document, PlainGltf& plain) {
    for (size_t i = 0; i < list_of(plain.json, "bufferViews").size(); ++i) {
        Json& view = plain.json["bufferViews"][i];
        const auto bytes = bytes_of_view(document.model, i);
        plain.views.emplace_back(bytes.begin(), bytes.end());
        for (const char* name : meshopt_names) erase_extension(view, name);
    }
}

size_t add_plain_view(PlainGltf& plain, std::span<const uint8_t> bytes) {
    plain.json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", bytes.size()}});
    plain.views.emplace_back(bytes.begin(), bytes.end());
    return plain.views.size() - 1;
}

/// The elements of a decoded accessor become a view of their own, described by `accessor`.
void describe_decoded(const tinygltf::Model& model, int decoded, size_t view, PlainGltf& plain, Json& accessor) {
    const tinygltf::Accessor& source = model.accessors.at(static_cast<size_t>(decoded));
    const auto bytes = bytes_of_view(model, static_cast<size_t>(source.bufferView));
    const size_t size = element_size(source);
    const auto step =
        static_cast<size_t>(source.ByteStride(model.bufferViews.at(static_cast<size_t>(source.bufferView))));
    // Vertex attributes begin at multiples of four bytes.
    const size_t stride = source.type == TINYGLTF_TYPE_SCALAR ? size : (size + 3) / 4 * 4;
    std::vector<uint8_t> packed(stride * source.count, 0);
    for (size_t i = 0; i < source.count; ++i)
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(source.byteOffset + i * step), size,
                    packed.begin() + static_cast<std::ptrdiff_t>(i * stride));
    accessor["componentType"] = source.componentType;
    accessor["count"] = source.count;
    accessor["bufferView"] = view;
    accessor.erase("byteOffset");
    accessor.erase("sparse");
    Json& description = plain.json["bufferViews"][view];
    description.erase("byteStride");
    if (stride != size) description["byteStride"] = stride;
    plain.views[view] = std::move(packed);
}

/// Gives Draco's result the places that its accessors and its compressed view had, so that no dead data
/// stays.
class DracoPlaces {
  public:
    DracoPlaces(const tinygltf::Model& model, PlainGltf& plain) : model_(model), plain_(plain) {
        for (const Json& accessor : list_of(plain.json, "accessors"))
            used_views_.insert(accessor.value("bufferView", size_t{SIZE_MAX}));
        for (const Json& image : list_of(plain.json, "images"))
            used_views_.insert(image.value("bufferView", size_t{SIZE_MAX}));
    }

    void replace(Json& primitive, const tinygltf::Primitive& decoded) {
        const Json* extension = extension_of(primitive, draco);
        if (extension == nullptr) return;
        size_t compressed_view = extension->value("bufferView", size_t{SIZE_MAX});
        const auto replace_one = [&](Json& index, int accessor) {
            if (index.is_number() && index.get<int>() == accessor) return;  // not part of the compressed data
            index = place(index, accessor, compressed_view);
            compressed_view = SIZE_MAX;
        };
        for (const auto& [name, accessor] : decoded.attributes) replace_one(primitive["attributes"][name], accessor);
        if (decoded.indices >= 0) replace_one(primitive["indices"], decoded.indices);
        primitive["mode"] = decoded.mode;
        erase_extension(primitive, draco);
    }

  private:
    size_t place(const Json& index, int decoded, size_t view) {
        Json& accessors = plain_.json["accessors"];
        size_t place = index.is_number() ? index.get<size_t>() : accessors.size();
        Json accessor = place < accessors.size() ? accessors[place] : Json::object();
        if (place < accessors.size() && !placed_.insert(place).second) place = accessors.size();
        if (!accessor.contains("type")) accessor["type"] = "SCALAR";  // indices that the file did not announce
        const bool is_view_free = view < plain_.views.size() && used_views_.insert(view).second;
        if (!is_view_free) view = add_plain_view(plain_, {});
        describe_decoded(model_, decoded, view, plain_, accessor);
        if (place == accessors.size()) {
            accessors.push_back(accessor);
        } else {
            accessors[place] = accessor;
        }
        return place;
    }

    const tinygltf::Model& model_;
    PlainGltf& plain_;
    std::set<size_t> used_views_;
    std::set<size_t> placed_;  ///< accessors whose place is taken
};

void replace_draco(const tinygltf::Model& model, PlainGltf& plain) {
    DracoPlaces places(model, plain);
    if (!plain.json.contains("meshes")) return;
    Json& meshes = plain.json["meshes"];
    for (size_t m = 0; m < meshes.size(); ++m) {
        Json& primitives = meshes[m]["primitives"];
        for (size_t p = 0; p < primitives.size(); ++p)
            places.replace(primitives[p], model.meshes.at(m).primitives.at(p));
    }
}

std::string mime_type_of(std::span<const uint8_t> image) {
    struct Signature {
        std::string_view bytes;
        size_t offset;
        const char* type;
    };
    constexpr std::array signatures{
        Signature{"\x89PNG", 0, "image/png"},     Signature{"\xFF\xD8\xFF", 0, "image/jpeg"},
        Signature{"\xABKTX 20", 0, "image/ktx2"}, Signature{"WEBP", 8, "image/webp"},
        Signature{"DDS ", 0, "image/vnd-ms.dds"}, Signature{"ftypavif", 4, "image/avif"}};
    for (const Signature& signature : signatures) {
        if (image.size() < signature.offset + signature.bytes.size()) continue;
        const std::string_view begin(reinterpret_cast<const char*>(image.data()) + signature.offset,
                                     signature.bytes.size());
        if (begin == signature.bytes) return signature.type;
    }
    return "";
}

void embed_images(const GltfDocument& document, PlainGltf& plain) {
    for (size_t i = 0; i < list_of(plain.json, "images").size(); ++i) {
        Json& image = plain.json["images"][i];
        const auto bytes = encoded_image(document, i);
        if (!image.contains("uri") || bytes.empty()) continue;
        const std::string found = mime_type_of(bytes);
        const std::string type = found.empty() ? image.value("mimeType", std::string()) : found;
        if (type.empty()) continue;  // a format without a name cannot lie in a buffer view
        image["bufferView"] = add_plain_view(plain, bytes);
        image["mimeType"] = type;
        image.erase("uri");
    }
}

}  // namespace

PlainGltf load_plain_gltf(const std::filesystem::path& path) {
    GltfDocument document = load_document(path);
    check_total_size(document.model, path);
    PlainGltf plain;
    plain.json = std::move(document.json);
    copy_views(document, plain);
    replace_draco(document.model, plain);
    embed_images(document, plain);
    declare_extension(plain.json, draco, false);
    for (const char* name : meshopt_names) declare_extension(plain.json, name, false);
    return plain;
}

}  // namespace surimi
