// SPDX-License-Identifier: Apache-2.0
// What lies flat on a monitor, a pane of glass or the mesh of the screen that it was put on: it is the monitor's front,
// not an occluder (M66).
#pragma once

#include <span>
#include <vector>

#include "baker/gather/panel.h"
#include "runtime/scene/scene.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Something that is parallel to a panel, close in front of it, and over at least half of it.
struct Cover {
    double height = 0;     ///< metres from the panel to the farthest of what covers it; 0: nothing does
    uint32_t surface = 0;  ///< index into Scene::surfaces, or beyond them as TriangleRef counts panels
};

/// The cover of a panel, at most a fiftieth of its shorter side in front of it. Costs some hundred rays.
Cover find_cover(const RayScene& rays, const Panel& panel, size_t monitor);

/// Raises the panels' clearance over their covers.
void clear_covers(const RayScene& rays, size_t monitor, std::span<Panel> panels);

/// A line for each monitor that has a cover, for people.
std::vector<std::string> describe_covers(const Scene& scene, const RayScene& rays);

}  // namespace surimi
