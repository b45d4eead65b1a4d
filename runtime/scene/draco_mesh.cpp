// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/accessor.h"

#include "runtime/scene/compressed.h"

#include <draco/compression/decode.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace surimi {
namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";

class DracoDecoder {
  public:
    DracoDecoder(tinygltf::Model& model, const std::filesystem::path& path) : model_(model), path_(path) {}

    void decode_all() {
        for (size_t m = 0; m < model_.meshes.size(); ++m)
            for (size_t p = 0; p < model_.meshes[m].primitives.size(); ++p) {
                tinygltf::Primitive& primitive = model_.meshes[m].primitives[p];
                const auto found = primitive.extensions.find(extension_name);
                if (found == primitive.extensions.end()) continue;
                place_ = place_name("mesh", m, model_.meshes[m].name) + ", primitive " + std::to_string(p) + ", " +
                         extension_name;
                const tinygltf::Value extension = found->second;
                primitive.extensions.erase(extension_name);
                decode_primitive(primitive, extension);
            }
        if (is_any_decoded_) model_.buffers.push_back(std::move(decoded_));
    }

  private:
    [[noreturn]] void refuse(const std::string& what) const { fail(path_, place_, what); }

    std::unique_ptr<draco::Mesh> decode_mesh(const tinygltf::Value& extension) const {
        const tinygltf::Value& index = extension.IsObject() ? extension.Get("bufferView") : extension;
        if (!index.IsInt() || index.Get<int>() < 0 ||
            static_cast<size_t>(index.Get<int>()) >= model_.bufferViews.size())
            refuse("its buffer view does not exist");
        const tinygltf::BufferView& view = model_.bufferViews[static_cast<size_t>(index.Get<int>())];
        const std::vector<uint8_t>& data = model_.buffers[static_cast<size_t>(view.buffer)].data;
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(data.data() + view.byteOffset), view.byteLength);
        draco::Decoder decoder;
        auto result = decoder.DecodeMeshFromBuffer(&buffer);
        if (!result.ok()) refuse("the compressed data is damaged (draco: " + result.status().error_msg_string() + ")");
        return std::move(result).value();
    }

    void decode_primitive(tinygltf::Primitive& primitive, const tinygltf::Value& extension) {
        const std::unique_ptr<draco::Mesh> mesh = decode_mesh(extension);
        const tinygltf::Value& attributes = extension.Get("attributes");
        if (!attributes.IsObject()) refuse("\"attributes\" must be an object");
        for (const std::string& name : attributes.Keys()) {
            const auto target = primitive.attributes.find(name);
            const tinygltf::Value& id = attributes.Get(name);
            if (target == primitive.attributes.end()) continue;  // compressed, but not used
            if (!id.IsInt() || id.Get<int>() < 0) refuse("\"" + name + "\" must be a whole number");
            const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(static_cast<uint32_t>(id.Get<int>()));
            if (attribute == nullptr) refuse("attribute " + name + " is not in the compressed data");
            target->second = append_attribute(*mesh, *attribute, target->second, name);
        }
        primitive.indices = append_indices(*mesh, primitive.indices);
        is_any_decoded_ = true;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;  // strips, too, are decoded to a list
    }

    int append_attribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int old,
                         const std::string& name) {
        tinygltf::Accessor accessor = model_.accessors[static_cast<size_t>(old)];
        std::vector<uint8_t> bytes;
        bool is_decoded = false;
        switch (accessor.componentType) {
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                is_decoded = convert<int8_t>(mesh, attribute, accessor, bytes);
                break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                is_decoded = convert<uint8_t>(mesh, attribute, accessor, bytes);
                break;
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                is_decoded = convert<int16_t>(mesh, attribute, accessor, bytes);
                break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                is_decoded = convert<uint16_t>(mesh, attribute, accessor, bytes);
                break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                is_decoded = convert<uint32_t>(mesh, attribute, accessor, bytes);
                break;
            default:
                is_decoded = convert<float>(mesh, attribute, accessor, bytes);
                break;
        }
        if (!is_decoded) refuse("attribute " + name + " cannot be decoded to the type of its accessor");
        accessor.count = mesh.num_points();
        const size_t stride = accessor.count > 0 ? bytes.size() / accessor.count : 0;
        return append(std::move(accessor), bytes, stride, TINYGLTF_TARGET_ARRAY_BUFFER);
    }

    /// Elements start at multiples of four bytes, as glTF wants.
    template <class Component>
    bool convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const tinygltf::Accessor& accessor,
                 std::vector<uint8_t>& bytes) const {
        const size_t components = component_count(accessor);
        const size_t stride = (components * sizeof(Component) + 3) / 4 * 4;
        bytes.assign(stride * mesh.num_points(), 0);
        std::vector<Component> element(components);
        for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
            const draco::AttributeValueIndex value = attribute.mapped_index(point);
            if (value.value() >= attribute.size()) return false;
            if (!attribute.ConvertValue<Component>(value, static_cast<int8_t>(components), element.data()))
                return false;
            std::memcpy(&bytes[stride * point.value()], element.data(), components * sizeof(Component));
        }
        return true;
    }

    int append_indices(const draco::Mesh& mesh, int old) {
        std::vector<uint8_t> bytes(static_cast<size_t>(mesh.num_faces()) * 3 * sizeof(uint32_t));
        for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t index = mesh.face(face)[k].value();
                std::memcpy(&bytes[(face.value() * 3 + k) * sizeof index], &index, sizeof index);
            }
        tinygltf::Accessor accessor;
        if (old >= 0) accessor.name = model_.accessors[static_cast<size_t>(old)].name;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        accessor.count = static_cast<size_t>(mesh.num_faces()) * 3;
        return append(std::move(accessor), bytes, 0, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    }

    int append(tinygltf::Accessor accessor, const std::vector<uint8_t>& bytes, size_t stride, int target) {
        tinygltf::BufferView view;
        view.buffer = static_cast<int>(model_.buffers.size());
        view.byteOffset = decoded_.data.size();
        view.byteLength = bytes.size();
        view.byteStride = stride;
        view.target = target;
        decoded_.data.insert(decoded_.data.end(), bytes.begin(), bytes.end());
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.byteOffset = 0;
        accessor.sparse.isSparse = false;
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    tinygltf::Model& model_;
    const std::filesystem::path& path_;
    std::string place_;
    tinygltf::Buffer decoded_;
    bool is_any_decoded_ = false;
};

}  // namespace

void decode_draco(tinygltf::Model& model, const std::filesystem::path& path) {
    DracoDecoder(model, path).decode_all();
    std::erase(model.extensionsUsed, extension_name);
    std::erase(model.extensionsRequired, extension_name);
}

}  // namespace surimi
