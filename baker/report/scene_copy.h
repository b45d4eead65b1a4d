// SPDX-License-Identifier: Apache-2.0
// The copy of the baked scene that the page's live view shows: all of its shapes, as small as is simple.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi {

/// Textures, beside the map, that a copy carries along, bytes: with more, or in a format that not every browser reads,
/// materials get the mean of their base colour instead.
inline constexpr size_t most_texture_bytes = 1 << 20;

/// What a packed copy may have, bytes; for more there is no live view.
inline constexpr size_t most_scene_bytes = 8 << 20;

struct SceneCopy {
    std::vector<uint8_t> glb_gzip;  ///< empty: it would be too large
    bool has_textures = true;       ///< false: they were replaced by their mean colours
    size_t bytes = 0;               ///< that the packed copy has, or would have
};

/// Copies the glb of a bake, which read_gltf read as `baked`. Every material that carries the map carries one white
/// texel in its place (KHR_materials_clearcoat, factor 0), for the page has the map already; nothing refers to other
/// files; animations are left out, since the map is that of the pose at rest. Throws Error(scene).
SceneCopy copy_scene(const std::filesystem::path& glb, const Scene& baked);

}  // namespace surimi
