// SPDX-License-Identifier: Apache-2.0
// What the manifest of a bake and the report of an unwrap have in common.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Where the UVs come from, and why where that was a choice.
nlohmann::ordered_json uv_section(const Atlas& atlas);

/// What got more or fewer texels, and why. Each cause on its own: where two hold for a chart, its density has both
/// factors.
nlohmann::ordered_json weights_section(const Scene& scene, const Atlas& atlas);

/// What reading the scene dropped or repaired.
nlohmann::ordered_json notes_section(const Scene& scene);

}  // namespace surimi
