// SPDX-License-Identifier: Apache-2.0
// Which charts light from a monitor could reach if nothing stood in between.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi {

/// The panels of a scene's monitors, ready to be asked.
struct PanelPlanes {
    struct Panel {
        std::vector<Vec3> corners;
        Vec3 normal{0};  ///< unit, of the front
        bool is_two_sided = false;
    };
    struct Group {
        std::vector<Panel> panels;
        Bounds box;  ///< of all their corners
    };
    std::vector<Group> monitors;  ///< as in Scene::monitors
    double tolerance = 0;         ///< metres: nearer to a plane than that is on it
};

/// The tolerance is 4.8e-7 of the scene's diagonal, four steps of a float: that far files put points off planes.
PanelPlanes panel_planes(const Scene& scene);

/// Whether a point in front of a panel and above whose triangle that panel rises is among the triangles `faces` of
/// `surface`; panels of the surface's own monitor do not count. Exact up to the tolerance: false means that for every
/// triangle and panel the triangle lies wholly behind the panel's plane, or the panel wholly below the triangle's,
/// so that the visibility is 0 or has no value everywhere on these faces, whatever the shading normals.
bool is_reached(const PanelPlanes& planes, const Surface& surface, const std::vector<uint32_t>& faces);

}  // namespace surimi
