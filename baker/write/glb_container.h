// SPDX-License-Identifier: Apache-2.0
// The binary container of glTF: a header, a chunk of JSON, a chunk of bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace surimi {

/// A .glb of these two chunks; without a second chunk when `binary` is empty.
/// Throws Error(cannot_write) beyond the 4 GiB that the container can say.
std::vector<uint8_t> make_glb(std::string_view json, std::span<const uint8_t> binary);

}  // namespace surimi
