// SPDX-License-Identifier: Apache-2.0
// What is probably wrong with a monitor's placement.
#pragma once

#include <string>
#include <vector>

#include "runtime/trace/ray_scene.h"

namespace surimi {

/// One sentence for each monitor whose front faces a surface closer than its own height: a flipped quad, mostly. Looks
/// along the front normal from nine points of each panel and takes the median distance.
std::vector<std::string> monitor_warnings(const Scene& scene, const RayScene& rays);

}  // namespace surimi
