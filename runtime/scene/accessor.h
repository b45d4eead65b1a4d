// SPDX-License-Identifier: Apache-2.0
// glTF accessors: do they lie within their buffers, and what numbers do they hold?
#pragma once

#include "runtime/scene/gltf_document.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace surimi {

size_t component_size(int component_type);  ///< bytes; 0 for an unknown type
size_t component_count(const tinygltf::Accessor& accessor);
/// Bytes of one element, with the padding that glTF puts between columns of small matrices.
size_t element_size(const tinygltf::Accessor& accessor);

/// "accessor 7 (positions)".
std::string accessor_name(const tinygltf::Model& model, int accessor);

/// Checks that every buffer view lies in its buffer and every accessor, with its sparse part, in its views;
/// and that sparse indices exist. Throws Error(scene).
void check_layout(const tinygltf::Model& model, const std::filesystem::path& path);

/// All components of all elements, in order; normalised integers become [0, 1] or [-1, 1]. Of matrices the
/// columns, without padding. An accessor without a view is zeros. Only for a model that passed check_layout.
std::vector<double> read_accessor(const tinygltf::Model& model, int accessor);

/// As read_accessor, but whole and exact, for vertex indices and joints (unsigned 8, 16, 32 bit).
std::vector<uint32_t> read_whole_accessor(const tinygltf::Model& model, int accessor);

}  // namespace surimi
