// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 -> Scene. Files are hostile: every index, offset and number is checked before use.
#pragma once

#include <filesystem>

#include "runtime/scene/scene.h"

namespace surimi {

/// Reads a .gltf or .glb with its buffers and images (files, data URIs, binary chunk). Applies the node
/// hierarchy, expands strips and fans, decodes sparse, normalised, quantised, meshopt- and Draco-compressed
/// attributes, makes flat normals where there are none, and takes skins and morph targets in their rest pose.
/// Whatever is merely odd is repaired or dropped, counted and named in Scene::notes. Throws Error(scene),
/// naming file and place, for data that is missing, out of range, not finite or not supported.
Scene read_gltf(const std::filesystem::path& path);

}  // namespace surimi
