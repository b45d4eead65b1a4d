// SPDX-License-Identifier: Apache-2.0
// The elements of glTF accessors as bytes: moved and measured without being converted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace surimi {

/// Bytes of one element, with the padding between columns of small matrices. For this and the following,
/// `accessor` is an entry of a checked document's "accessors".
size_t element_size(const nlohmann::json& accessor);

/// The elements of an accessor, one after the other, as stored; sparse ones filled in. `document` has
/// "accessors" and "bufferViews", `views` the bytes of the latter. Throws Error(scene) when they reach beyond
/// their view.
std::vector<uint8_t> elements_of(const nlohmann::json& document, const std::vector<std::span<const uint8_t>>& views,
                                 int accessor);

/// The elements as vertex numbers.
std::vector<uint32_t> whole_numbers(const nlohmann::json& accessor, std::span<const uint8_t> elements);

/// Brings min and max in line with the elements; leaves them as written when they say the right numbers.
void set_bounds(nlohmann::json& accessor, std::span<const uint8_t> elements);

}  // namespace surimi
