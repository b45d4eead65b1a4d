// SPDX-License-Identifier: Apache-2.0
#include "baker/write/elements.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "runtime/base/error.h"

namespace surimi {
namespace {

using Json = nlohmann::json;

/// How the elements of an accessor lie in memory.
struct ElementFormat {
    int64_t component_type = 5126;
    size_t component_size = 4;
    size_t components = 1;  ///< values, not counting the padding of matrix columns
    size_t size = 4;        ///< bytes of one element
};

size_t component_size(int64_t type) {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        default:
            return 4;
    }
}

ElementFormat format_of(const Json& accessor) {
    ElementFormat format;
    format.component_type = accessor.at("componentType").get<int64_t>();
    format.component_size = component_size(format.component_type);
    const auto type = accessor.at("type").get<std::string>();
    const bool is_matrix = type.starts_with("MAT");
    const size_t rows = type == "SCALAR" ? 1 : static_cast<size_t>(type[3] - '0');
    const size_t columns = is_matrix ? rows : 1;
    const size_t column_size = rows * format.component_size;
    format.components = rows * columns;
    // The columns of a matrix begin at multiples of four bytes, whatever its components.
    format.size = is_matrix ? columns * ((column_size + 3) / 4 * 4) : column_size;
    return format;
}

double component_value(const uint8_t* bytes, int64_t type) {
    const auto read = [bytes](auto value) {
        std::memcpy(&value, bytes, sizeof value);
        return static_cast<double>(value);
    };
    switch (type) {
        case 5120:
            return read(int8_t{});
        case 5121:
            return read(uint8_t{});
        case 5122:
            return read(int16_t{});
        case 5123:
            return read(uint16_t{});
        case 5125:
            return read(uint32_t{});
        default:
            return read(float{});
    }
}

[[noreturn]] void throw_out_of_range(int accessor) {
    throw Error(ErrorKind::scene,
                "accessor " + std::to_string(accessor) + ": reaches beyond its data; export the scene again");
}

struct ElementBounds {
    std::vector<double> low;  ///< empty: no component-wise bounds
    std::vector<double> high;
};

/// Values that are not finite do not count, for JSON cannot say them; where a component has no finite value
/// at all there are no bounds.
ElementBounds bounds_of(const ElementFormat& format, std::span<const uint8_t> elements) {
    if (format.size != format.components * format.component_size) return {};  // padded matrices: bounds are optional
    ElementBounds bounds{std::vector<double>(format.components, std::numeric_limits<double>::infinity()),
                         std::vector<double>(format.components, -std::numeric_limits<double>::infinity())};
    for (size_t offset = 0; offset < elements.size(); offset += format.size)
        for (size_t c = 0; c < format.components; ++c) {
            const double value = component_value(&elements[offset + c * format.component_size], format.component_type);
            if (!std::isfinite(value)) continue;
            bounds.low[c] = std::min(bounds.low[c], value);
            bounds.high[c] = std::max(bounds.high[c], value);
        }
    for (size_t c = 0; c < format.components; ++c)
        if (!(bounds.low[c] <= bounds.high[c])) return {};
    return bounds;
}

bool says(const Json& list, const std::vector<double>& values) {
    if (!list.is_array() || list.size() != values.size()) return false;
    for (size_t c = 0; c < values.size(); ++c)
        if (static_cast<float>(list[c].get<double>()) != static_cast<float>(values[c])) return false;
    return true;
}

Json as_numbers(const std::vector<double>& values, bool is_float) {
    Json list = Json::array();
    for (const double value : values) list.push_back(is_float ? Json(value) : Json(static_cast<int64_t>(value)));
    return list;
}

}  // namespace

size_t element_size(const Json& accessor) {
    return format_of(accessor).size;
}

std::vector<uint8_t> elements_of(const Json& document, const std::vector<std::span<const uint8_t>>& views,
                                 int accessor) {
    const Json& description = document.at("accessors").at(static_cast<size_t>(accessor));
    const ElementFormat format = format_of(description);
    const auto count = description.at("count").get<size_t>();
    std::vector<uint8_t> result(count * format.size, 0);
    // Bytes of a view from an offset on; at least `size` of them.
    const auto bytes_of = [&](const Json& place, size_t size) {
        const auto bytes = views.at(place.at("bufferView").get<size_t>());
        const auto offset = place.value("byteOffset", size_t{0});
        if (offset > bytes.size() || bytes.size() - offset < size) throw_out_of_range(accessor);
        return bytes.subspan(offset);
    };
    if (description.contains("bufferView") && count > 0) {
        const Json& view = document.at("bufferViews").at(description["bufferView"].get<size_t>());
        const size_t stride = view.value("byteStride", format.size);
        const auto bytes = bytes_of(description, (count - 1) * stride + format.size);
        for (size_t i = 0; i < count; ++i) std::memcpy(&result[i * format.size], &bytes[i * stride], format.size);
    }
    if (!description.contains("sparse")) return result;
    const Json& sparse = description["sparse"];
    const auto sparse_count = sparse.at("count").get<size_t>();
    const auto type = sparse.at("indices").at("componentType").get<int64_t>();
    const size_t index_size = component_size(type);
    const auto positions = bytes_of(sparse["indices"], sparse_count * index_size);
    const auto values = bytes_of(sparse.at("values"), sparse_count * format.size);
    for (size_t i = 0; i < sparse_count; ++i) {
        const auto at = static_cast<size_t>(component_value(&positions[i * index_size], type));
        if (at >= count) throw_out_of_range(accessor);
        std::memcpy(&result[at * format.size], &values[i * format.size], format.size);
    }
    return result;
}

std::vector<uint32_t> whole_numbers(const Json& accessor, std::span<const uint8_t> elements) {
    const ElementFormat format = format_of(accessor);
    std::vector<uint32_t> result(elements.size() / format.size);
    for (size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<uint32_t>(component_value(&elements[i * format.size], format.component_type));
    return result;
}

void set_bounds(Json& accessor, std::span<const uint8_t> elements) {
    const ElementFormat format = format_of(accessor);
    const ElementBounds bounds = bounds_of(format, elements);
    if (says(accessor.value("min", Json()), bounds.low) && says(accessor.value("max", Json()), bounds.high)) return;
    accessor.erase("min");
    accessor.erase("max");
    if (bounds.low.empty()) return;
    accessor["min"] = as_numbers(bounds.low, format.component_type == 5126);
    accessor["max"] = as_numbers(bounds.high, format.component_type == 5126);
}

}  // namespace surimi
