// SPDX-License-Identifier: Apache-2.0
// A glTF file as its JSON and the bytes of its buffer views, with nothing compressed and nothing outside.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

namespace surimi {

struct PlainGltf {
    nlohmann::json json;
    std::vector<std::vector<uint8_t>> views;  ///< bytes of json["bufferViews"], decoded
};

/// Reads a file that read_gltf accepts. Draco and meshopt are decoded, and their extensions gone; images that
/// lie outside become buffer views (a missing one stays a name). The JSON is otherwise the file's, but
/// "buffers", "buffer" and "byteOffset" of the views mean nothing any more. Throws Error(scene).
PlainGltf load_plain_gltf(const std::filesystem::path& path);

}  // namespace surimi
