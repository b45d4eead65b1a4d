// SPDX-License-Identifier: Apache-2.0
// A glTF file in memory, uncompressed and checked: every index, offset and count in it may be used.
#pragma once

#include "runtime/scene/scene.h"

// Whoever includes tiny_gltf.h does so through this header, so that these are the same everywhere: images
// stay encoded (runtime/image decodes them), and files are read here and not by tinygltf.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surimi {

struct GltfDocument {
    std::filesystem::path path;
    nlohmann::json json;    ///< as the file has it; tinygltf's values lose nulls, empty objects and large integers
    tinygltf::Model model;  ///< buffers filled, compressed data decoded and their extensions removed
    std::vector<std::vector<uint8_t>> external_images;  ///< encoded bytes of images that are not in a buffer view
    std::vector<Note> notes;
};

/// Reads a .gltf or .glb with all its buffers and encoded images. A missing image is a note and has no bytes.
/// Throws Error(scene), naming file and place, for whatever is missing, malformed, out of range or required
/// and unknown.
GltfDocument load_document(const std::filesystem::path& path);

/// The encoded bytes (PNG, JPEG, ...) of an image; empty when its file is missing.
std::span<const uint8_t> encoded_image(const GltfDocument& document, size_t image);

/// "mesh 3 (Chair)": how messages name a thing of the file.
std::string place_name(std::string_view kind, size_t index, const std::string& name);

/// Throws Error(scene): "file: place: what".
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& place, const std::string& what);

}  // namespace surimi
