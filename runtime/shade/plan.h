// SPDX-License-Identifier: Apache-2.0
// What of the lighting a scene calls for, decided before the first pixel.
#pragma once

#include <vector>

#include "runtime/light/lit_monitor.h"
#include "runtime/map/visibility_map.h"
#include "runtime/scene/scene.h"

namespace surimi {

struct MonitorPlan {
    bool is_lit = true;           ///< its radiance is not 0; else nothing of it is computed
    bool is_ever_blocked = true;  ///< some texel of its channel is below 1; else the map is not read for it
    double darkest = 0;           ///< least V in its channel
    double dark_share = 0;        ///< share of the maps' texels where V is 0: nothing is computed there
    bool has_picture = false;     ///< it shows an image, so a lookup goes with each integral
};

struct ShadingPlan {
    std::vector<MonitorPlan> monitors;  ///< in the order of Scene::monitors
    std::vector<bool> is_specular;      ///< for each of Scene::materials: it can reflect a highlight
    std::vector<bool> is_diffuse;       ///< it has a Lambert part: not a metal throughout
};

/// `pages` are the maps of a bake, by page. Without one no monitor counts as blocked.
ShadingPlan plan_shading(const Scene& scene, const std::vector<LitMonitor>& lights,
                         const std::vector<VisibilityMap>& pages);

/// What was computed and what was not, over all points of one monitor.
struct MonitorCounts {
    size_t points = 0;
    size_t unseen = 0;      ///< the monitor's own, behind it, below its horizon, or the monitor is off
    size_t dark = 0;        ///< the map says 0
    size_t diffuse = 0;     ///< Lambert integrals
    size_t specular = 0;    ///< integrals of the full lobe
    size_t schlick = 0;     ///< integrals of Schlick's lobe, where it is not negligible
    size_t map_reads = 0;   ///< V that came from the map
    size_t not_finite = 0;  ///< points that got 0 because something about them was not finite
    MonitorCounts& operator+=(const MonitorCounts& other);
};

}  // namespace surimi
