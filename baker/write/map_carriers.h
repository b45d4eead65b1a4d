// SPDX-License-Identifier: Apache-2.0
// How materials carry the map, or the page of it that their surface lies on: a texture on a layer that is switched
// off, and a mark in the extras that says so.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "baker/write/gltf_edit.h"

namespace surimi {

/// What a primitive asks of its materials.
struct MaterialNeed {
    int page = -1;      ///< of the map that the material carries; -1: it carries none
    int moved_set = 0;  ///< the primitive's former TEXCOORD_1 is now TEXCOORD_moved_set; 0: it did not move
};

/// By mesh and primitive of the document; primitives that are not listed ask for nothing.
using MaterialNeeds = std::map<std::pair<size_t, size_t>, MaterialNeed>;

/// A page of the map as materials refer to it.
struct PageReference {
    int texture = -1;  ///< index into "textures"; -1: there is no map yet, and only the page's number is marked
    std::string file;  ///< where it lies for materials that have no layer left to carry it
};

struct MapReference {
    Json channels;  ///< three names, empty where unused
    std::vector<PageReference> pages;
};

/// Whether a texture of any material of `primitive`, variants included, reads TEXCOORD_`set`.
bool reads_set(const Json& document, const Json& primitive, int set);

/// Takes the map of an earlier bake off all materials, since new UVs make it wrong. Returns at most `page_count`
/// textures that nothing uses any more. Those beyond are removed with their images, where that renumbers nothing.
std::vector<int> remove_carried_map(GltfEdit& edit, size_t page_count);

/// Embeds the PNG as a texture (linear, clamped), in the place of `replaced` if that is not -1.
int add_map_texture(GltfEdit& edit, std::span<const uint8_t> png, const std::string& name, int replaced);

/// Gives every primitive materials that meet its need, copying those that are shared by primitives of other
/// needs. KHR_materials_clearcoat carries the map; if the material uses it itself, KHR_materials_sheen; if it
/// allows neither, the mark names the file.
void assign_materials(GltfEdit& edit, const MaterialNeeds& needs, const MapReference& map);

}  // namespace surimi
