// SPDX-License-Identifier: Apache-2.0
// A monitor: planar polygons that emit uniform diffuse radiance from their front side.
#pragma once

#include <string>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

/// A planar convex polygon in world space, metres. Corners run counter-clockwise seen from the front, the
/// side that emits. At least three corners, area greater than zero.
struct Polygon {
    std::vector<Vec3> corners;
};

/// Unit normal of the front side. Newell's sum, so that short edges do not decide.
Vec3 front_normal(const Polygon& polygon);
double area(const Polygon& polygon);

struct Monitor {
    std::string name;        ///< of its node; names its layers in the files
    int node = -1;           ///< index into Scene::nodes, or -1 for a rectangle given in the configuration
    int channel = 0;         ///< 0, 1, 2: R, G, B of the map; unique within a scene
    Vec3 radiance{1};        ///< linear RGB, nits; does not influence the map
    bool two_sided = false;  ///< the back emits as well (extras.monitor_two_sided)
    std::vector<Polygon> panels;
    std::string reason;  ///< the rule that found it, for people: "node name Monitor_R"
};

double area(const Monitor& monitor);

}  // namespace surimi
