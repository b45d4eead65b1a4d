// SPDX-License-Identifier: Apache-2.0
// Decodes KHR_draco_mesh_compression and EXT/KHR_meshopt_compression into plain buffers.
#pragma once

#include "runtime/scene/gltf_document.h"

#include <filesystem>

namespace surimi {

/// Decodes every buffer view that is compressed with meshopt into a new buffer; afterwards no view, buffer or
/// extension list mentions the extension. To be called before check_layout. Throws Error(scene).
void decode_meshopt(tinygltf::Model& model, const std::filesystem::path& path);

/// Decodes every primitive that is compressed with Draco into new buffers, views and accessors, as a triangle
/// list; afterwards no primitive or extension list mentions the extension. To be called after check_layout,
/// because its compressed bytes lie in ordinary views. Throws Error(scene).
void decode_draco(tinygltf::Model& model, const std::filesystem::path& path);

}  // namespace surimi
