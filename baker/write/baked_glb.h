// SPDX-License-Identifier: Apache-2.0
// The input scene, all of it, plus TEXCOORD_1 and the map.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// What a glb carries beside the scene; without `pngs`: the UVs alone (`surimi unwrap`).
struct CarriedMap {
    std::vector<std::span<const uint8_t>> pngs;  ///< the 8-bit sRGB-encoded map of each page of the atlas
    std::array<std::string, 3> channels;         ///< monitor node of R, G, B; empty where unused
};

/// Reads scene.path again and returns it as a binary glTF in which every placed primitive has the atlas' UVs as
/// TEXCOORD_1 (vertices split where charts need it, one mesh for each placement), every receiver's material carries
/// the map of its page (KHR_materials_clearcoat with factor 0, texCoord 1, and extras.visibilityMap), and every
/// monitor's node has extras.monitor. With several pages extras.visibilityMap.page has the number, also without a map,
/// and a material that is used on several is copied for each. Everything else of the input is kept: nodes, cameras,
/// skins, animations, extensions, extras, image bytes. Strips and fans become triangle lists; compressed buffers become
/// plain ones. Throws Error(scene) when the file cannot be read any more.
std::vector<uint8_t> make_baked_glb(const Scene& scene, const Atlas& atlas, const CarriedMap& map);

}  // namespace surimi
