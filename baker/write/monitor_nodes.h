// SPDX-License-Identifier: Apache-2.0
// The monitors of a bake as the baked file tells them: marked nodes, and new ones for monitors that had none.
#pragma once

#include "baker/write/gltf_edit.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Writes extras.monitor ("R", "G" or "B") into every monitor's node, and false into marked nodes that are no
/// monitor of this bake. Monitors that the configuration describes get a node with an emissive mesh. Extras
/// that are no object cannot be marked and stay as they are.
void mark_monitors(GltfEdit& edit, const Scene& scene);

}  // namespace surimi
