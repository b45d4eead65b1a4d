// SPDX-License-Identifier: Apache-2.0
// A monitor's panels as the methods of this room see them: flat coordinates, and where the light begins.
#pragma once

#include <vector>

#include "runtime/base/math.h"
#include "runtime/light/monitor.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Places are relative to RayScene::center(). A point of the panel's plane is center + s * axis_s + t * axis_t; the
/// axes are perpendicular and scaled so that the polygon lies in [-1, 1]^2.
struct Panel {
    Vec3 center{0}, axis_s{1, 0, 0}, axis_t{0, 1, 0};
    Vec3 normal{0, 0, 1};       ///< unit, front side; axis_s x axis_t points there
    std::vector<Vec2> corners;  ///< in (s, t), counter-clockwise seen from the front
    std::vector<Vec3> places;   ///< the same in space
    double clearance = 0;       ///< metres in front of the plane within which nothing counts as an occluder
    bool is_two_sided = false;
};

/// The panels of a monitor. The clearance is 1e-4 of the panel's diameter and 64 half-ulps of the largest coordinate:
/// a screen glued to its wall, or let into it, is not hidden by it.
std::vector<Panel> panels_of(const Monitor& monitor, const RayScene& rays);

/// The share of the way from `origin` to any point of the panel at which it comes within the clearance; 0 when the
/// origin is closer than that. Rays end there.
double end_of_rays(const Panel& panel, const Vec3& origin);

}  // namespace surimi
