// SPDX-License-Identifier: Apache-2.0
// What the manifest of a bake and the report of an unwrap have in common.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Where the UVs come from, and why where that was a choice.
nlohmann::ordered_json uv_section(const Atlas& atlas);

/// Surfaces that got fewer texels, and why.
nlohmann::ordered_json caps_section(const Scene& scene, const Atlas& atlas);

/// What reading the scene dropped or repaired.
nlohmann::ordered_json notes_section(const Scene& scene);

}  // namespace surimi
