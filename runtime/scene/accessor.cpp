// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

namespace surimi {
namespace {

// An accessor without a view takes no room in the file, so its count says nothing about what the user can
// afford: a few bytes must not ask for gigabytes. 10 million vertices are a quarter of a gigabyte.
constexpr size_t largest_viewless_count = 10'000'000;

/// Where the elements of an accessor, or of its sparse part, lie in memory.
struct Elements {
    const uint8_t* first = nullptr;
    size_t stride = 0;
    size_t count = 0;
};

template <class Component>
double load(const uint8_t* bytes, bool is_normalized) {
    Component component;
    std::memcpy(&component, bytes, sizeof component);  // files need not align anything
    const double value = static_cast<double>(component);
    if (!is_normalized || !std::numeric_limits<Component>::is_integer) return value;
    return std::max(value / static_cast<double>(std::numeric_limits<Component>::max()), -1.0);
}

double load_component(const uint8_t* bytes, int type, bool is_normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return load<int8_t>(bytes, is_normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<uint8_t>(bytes, is_normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return load<int16_t>(bytes, is_normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<uint16_t>(bytes, is_normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return load<uint32_t>(bytes, is_normalized);
        default:
            return load<float>(bytes, is_normalized);
    }
}

size_t row_count(int type) {
    if (type == TINYGLTF_TYPE_MAT2) return 2;
    if (type == TINYGLTF_TYPE_MAT3) return 3;
    if (type == TINYGLTF_TYPE_MAT4) return 4;
    return static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
}

/// Columns of matrices start at multiples of four bytes.
size_t column_stride(const tinygltf::Accessor& accessor) {
    const size_t bytes = row_count(accessor.type) * component_size(accessor.componentType);
    const bool is_matrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
                           accessor.type == TINYGLTF_TYPE_MAT4;
    return is_matrix ? (bytes + 3) / 4 * 4 : bytes;
}

void load_element(const tinygltf::Accessor& accessor, const uint8_t* bytes, double* out) {
    const size_t rows = row_count(accessor.type);
    const size_t size = component_size(accessor.componentType);
    for (size_t c = 0; c < component_count(accessor); ++c)
        out[c] = load_component(bytes + c / rows * column_stride(accessor) + c % rows * size, accessor.componentType,
                                accessor.normalized);
}

Elements elements_in(const tinygltf::Model& model, int view_index, size_t offset, size_t count, size_t size) {
    const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(view_index)];
    const std::vector<uint8_t>& data = model.buffers[static_cast<size_t>(view.buffer)].data;
    return {data.data() + view.byteOffset + offset, view.byteStride > 0 ? view.byteStride : size, count};
}

/// The sparse parts are always packed, whatever stride their view claims.
Elements sparse_indices(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
    const auto& part = accessor.sparse.indices;
    Elements elements = elements_in(model, part.bufferView, static_cast<size_t>(part.byteOffset),
                                    static_cast<size_t>(accessor.sparse.count), component_size(part.componentType));
    elements.stride = component_size(part.componentType);
    return elements;
}

Elements sparse_values(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
    const auto& part = accessor.sparse.values;
    Elements elements = elements_in(model, part.bufferView, static_cast<size_t>(part.byteOffset),
                                    static_cast<size_t>(accessor.sparse.count), element_size(accessor));
    elements.stride = element_size(accessor);
    return elements;
}

/// Does [offset, offset + stride * (count - 1) + size) fit in `length`? Every step is checked for overflow.
bool fits(size_t offset, size_t stride, size_t count, size_t size, size_t length) {
    if (count == 0) return true;
    if (offset > length || size > length - offset) return false;
    return stride == 0 || count - 1 <= (length - offset - size) / stride;
}

class Layout {
  public:
    Layout(const tinygltf::Model& model, const std::filesystem::path& path) : model_(model), path_(path) {}

    void check_view(size_t v) const {
        const tinygltf::BufferView& view = model_.bufferViews[v];
        const size_t size = model_.buffers[static_cast<size_t>(view.buffer)].data.size();
        if (fits(view.byteOffset, 0, 1, view.byteLength, size)) return;
        fail(path_, place_name("buffer view", v, view.name),
             "bytes " + std::to_string(view.byteOffset) + " and " + std::to_string(view.byteLength) +
                 " more are outside buffer " + std::to_string(view.buffer) + ", which has " + std::to_string(size));
    }

    void check_accessor(size_t a) const {
        const tinygltf::Accessor& accessor = model_.accessors[a];
        const std::string place = place_name("accessor", a, accessor.name);
        const size_t size = element_size(accessor);
        if (size == 0) fail(path_, place, "its type is not one of glTF");
        if (accessor.bufferView < 0) {
            if (accessor.count > largest_viewless_count)
                fail(path_, place, "has " + std::to_string(accessor.count) + " elements, but no buffer view");
        } else {
            check_range(place, {accessor.bufferView, accessor.byteOffset, accessor.count, size, false});
        }
        if (accessor.sparse.isSparse) check_sparse(place, accessor);
    }

  private:
    struct Range {
        int view = 0;
        size_t offset = 0;
        size_t count = 0;
        size_t size = 0;         ///< bytes of one element
        bool is_packed = false;  ///< whatever stride the view has
    };

    void check_range(const std::string& place, const Range& range) const {
        const tinygltf::BufferView& view = model_.bufferViews[static_cast<size_t>(range.view)];
        const std::string where = "buffer view " + std::to_string(range.view);
        const size_t stride = !range.is_packed && view.byteStride > 0 ? view.byteStride : range.size;
        if (stride < range.size) fail(path_, place, "its elements are longer than the stride of " + where);
        if (fits(range.offset, stride, range.count, range.size, view.byteLength)) return;
        fail(path_, place,
             std::to_string(range.count) + " elements of " + std::to_string(range.size) + " bytes do not fit in " +
                 where + ", which has " + std::to_string(view.byteLength) + " bytes");
    }

    void check_sparse(const std::string& place, const tinygltf::Accessor& accessor) const {
        const auto& sparse = accessor.sparse;
        const size_t count = static_cast<size_t>(sparse.count);
        if (count > accessor.count) fail(path_, place, "its sparse part has more elements than the accessor");
        const size_t index_size = component_size(sparse.indices.componentType);
        const bool is_unsigned = sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                 sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                 sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        if (!is_unsigned) fail(path_, place, "its sparse indices are not unsigned integers");
        check_range(place, {sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset), count,
                            index_size, true});
        check_range(place, {sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), count,
                            element_size(accessor), true});
        const Elements indices = sparse_indices(model_, accessor);
        for (size_t i = 0; i < count; ++i) {
            const double index =
                load_component(indices.first + i * indices.stride, sparse.indices.componentType, false);
            if (index >= static_cast<double>(accessor.count))
                fail(path_, place,
                     "sparse index " + std::to_string(static_cast<uint64_t>(index)) + " is out of range (" +
                         std::to_string(accessor.count) + " elements)");
        }
    }

    const tinygltf::Model& model_;
    const std::filesystem::path& path_;
};

}  // namespace

size_t component_size(int component_type) {
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component_type));
    return size > 0 ? static_cast<size_t>(size) : 0;
}

size_t component_count(const tinygltf::Accessor& accessor) {
    const int count = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    return count > 0 ? static_cast<size_t>(count) : 0;
}

size_t element_size(const tinygltf::Accessor& accessor) {
    if (component_count(accessor) == 0) return 0;
    return component_count(accessor) / row_count(accessor.type) * column_stride(accessor);
}

std::string accessor_name(const tinygltf::Model& model, int accessor) {
    return place_name("accessor", static_cast<size_t>(accessor), model.accessors[static_cast<size_t>(accessor)].name);
}

void check_layout(const tinygltf::Model& model, const std::filesystem::path& path) {
    const Layout layout(model, path);
    for (size_t v = 0; v < model.bufferViews.size(); ++v) layout.check_view(v);
    for (size_t a = 0; a < model.accessors.size(); ++a) layout.check_accessor(a);
}

std::vector<double> read_accessor(const tinygltf::Model& model, int index) {
    const tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(index)];
    const size_t components = component_count(accessor);
    std::vector<double> values(accessor.count * components, 0.0);
    if (accessor.bufferView >= 0) {
        const Elements elements =
            elements_in(model, accessor.bufferView, accessor.byteOffset, accessor.count, element_size(accessor));
        for (size_t i = 0; i < elements.count; ++i)
            load_element(accessor, elements.first + i * elements.stride, &values[i * components]);
    }
    if (!accessor.sparse.isSparse) return values;
    const Elements indices = sparse_indices(model, accessor);
    const Elements replacements = sparse_values(model, accessor);
    for (size_t i = 0; i < indices.count; ++i) {
        const double target =
            load_component(indices.first + i * indices.stride, accessor.sparse.indices.componentType, false);
        load_element(accessor, replacements.first + i * replacements.stride,
                     &values[static_cast<size_t>(target) * components]);
    }
    return values;
}

std::vector<uint32_t> read_whole_accessor(const tinygltf::Model& model, int index) {
    const std::vector<double> values = read_accessor(model, index);  // doubles hold 32-bit integers exactly
    std::vector<uint32_t> whole(values.size());
    std::transform(values.begin(), values.end(), whole.begin(), [](double v) { return static_cast<uint32_t>(v); });
    return whole;
}

}  // namespace surimi
