// SPDX-License-Identifier: Apache-2.0
// Monitors as the user wants them to shine: --light and --picture.
#pragma once

#include <string>
#include <vector>

#include "runtime/light/lit_monitor.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// The scene's monitors with what the user changes: `lights` are NODE=R,G,B (linear, nits), `pictures` NODE=FILE (any
/// image; what has 8 bits is taken as sRGB-encoded). NODE is a monitor's name. Throws Error(usage) for a name that is
/// none, or numbers that are none.
std::vector<LitMonitor> chosen_lights(const Scene& scene, const std::vector<std::string>& lights,
                                      const std::vector<std::string>& pictures);

}  // namespace surimi
