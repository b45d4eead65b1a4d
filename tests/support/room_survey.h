// SPDX-License-Identifier: Apache-2.0
// A baked room against the truth by rays, at random points of its surfaces.
#pragma once

#include <string>
#include <vector>

#include "baker/bake.h"
#include "runtime/trace/ray_scene.h"
#include "tests/support/triangle_subtraction.h"

namespace surimi::test {

struct RoomPoint {
    SurfacePoint point;
    bool is_enclosed = false;  ///< other geometry is around it: nobody sees it
    double light = 0;          ///< form factor of the monitor, nothing in the way
    double truth = 0;          ///< visibility
    double value = 0;          ///< that the map gives
};

/// Form factor of a monitor at a point, nothing in the way, by a grid of places on its panels: good to some per cent.
double form_factor(const Scene& scene, size_t monitor, const SurfacePoint& point);

/// What rays need to know of a monitor's panels, without the scene's triangles.
Obstructed panels_alone(const Scene& scene, const RayScene& rays, size_t monitor);

/// Does the point lie in or against something? Of rays into its hemisphere, do most meet back faces first? Leaves
/// (alpha-masked) and sheets that engines show from both sides count as neither. Shares no code with the baker.
bool is_enclosed(const Scene& scene, const RayScene& rays, const SurfacePoint& point);

struct SurveySettings {
    size_t points = 4000;
    uint32_t rays = 1024;  ///< for each
    uint64_t seed = 7;
};

/// Points spread evenly over the area of what is no monitor, those that the monitor cannot light left out. `value` is
/// left 0.
std::vector<RoomPoint> survey_room(const Scene& scene, const RayScene& rays, size_t monitor,
                                   const SurveySettings& settings);

/// Puts the map's values in.
void read_values(const Bake& bake, int channel, std::vector<RoomPoint>& points);

/// Of those points that can be seen, or of all.
struct SurveyResult {
    size_t points = 0;
    double mean = 0, rmse = 0, p99 = 0, largest = 0;  ///< absolute errors
    size_t plain = 0;                                 ///< points whose truth is within 5 % of 0 or 1
    size_t leaks = 0;                                 ///< of those near 0, with a map of more than a half
    size_t shadows = 0;                               ///< of those near 1, with a map of less than a half
    size_t tenths = 0;                                ///< of both, off by more than 0.1
};
SurveyResult judge(const std::vector<RoomPoint>& points, bool is_all);

/// The worst points that can be seen, weighed by their light as eyes do, none within `apart` metres of another.
std::vector<RoomPoint> worst_of(std::vector<RoomPoint> points, size_t count, double apart);

}  // namespace surimi::test
