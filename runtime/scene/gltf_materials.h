// SPDX-License-Identifier: Apache-2.0
// glTF materials, textures and images -> Scene.
#pragma once

#include "runtime/scene/gltf_document.h"

namespace surimi {

/// What extras say about monitors; the same keys on nodes and on materials.
struct MonitorMark {
    bool is_marked = false;
    int channel = -1;
    bool is_two_sided = false;
    bool is_unclear = false;  ///< extras.monitor has a value that we do not know
};
MonitorMark read_monitor_mark(const nlohmann::json& object);

/// extras.texel_scale of a node or a material: a number from 0.001 to 1000. Without it 1; with something else 1 and a
/// note.
double read_texel_scale(const nlohmann::json& object, const std::string& place, Scene& scene);

/// Fills scene.materials. Extensions that change what we need and that we ignore are noted.
void read_materials(const GltfDocument& document, Scene& scene);

/// Fills scene.images: decodes those that a material uses; the others, and those that cannot be decoded, stay
/// empty.
void read_images(const GltfDocument& document, Scene& scene);

}  // namespace surimi
