// SPDX-License-Identifier: Apache-2.0
#include "baker/write/glb_container.h"

#include <string>

#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr uint32_t magic = 0x46546C67;       // "glTF"
constexpr uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr uint32_t bin_chunk = 0x004E4942;   // "BIN\0"
constexpr size_t header_size = 12;
constexpr size_t chunk_header_size = 8;

void append_u32(std::vector<uint8_t>& bytes, size_t value) {
    for (size_t i = 0; i < 4; ++i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

size_t padded(size_t size) {
    return (size + 3) / 4 * 4;
}

}  // namespace

std::vector<uint8_t> make_glb(std::string_view json, std::span<const uint8_t> binary) {
    const size_t binary_size = binary.empty() ? 0 : chunk_header_size + padded(binary.size());
    const size_t total = header_size + chunk_header_size + padded(json.size()) + binary_size;
    if (total > UINT32_MAX) {
        throw Error(ErrorKind::cannot_write, "the baked glb would have " + std::to_string(total) +
                                                 " bytes, but a .glb holds less than 4 GiB; split the scene");
    }
    std::vector<uint8_t> file;
    file.reserve(total);
    append_u32(file, magic);
    append_u32(file, 2);  // version of the container
    append_u32(file, total);
    append_u32(file, padded(json.size()));
    append_u32(file, json_chunk);
    file.insert(file.end(), json.begin(), json.end());
    file.resize(header_size + chunk_header_size + padded(json.size()), ' ');
    if (!binary.empty()) {
        append_u32(file, padded(binary.size()));
        append_u32(file, bin_chunk);
        file.insert(file.end(), binary.begin(), binary.end());
        file.resize(total, 0);
    }
    return file;
}

}  // namespace surimi
