// SPDX-License-Identifier: Apache-2.0
// What all texels of one monitor share.
#pragma once

#include <vector>

#include "baker/gather/cost.h"
#include "baker/gather/panel.h"
#include "baker/gather/settings.h"
#include "baker/gather/silhouettes.h"
#include "runtime/light/sample.h"
#include "runtime/scene/scene.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

struct MonitorSetup {
    const Scene& scene;
    const RayScene& rays;
    const Silhouettes& silhouettes;
    size_t monitor = 0;
    GatherSettings settings;
    Tolerances limits;  ///< of these settings
    std::vector<Panel> panels;
    std::vector<Silhouettes> cuts;  ///< for each panel, the edges at which its clearance cuts triangles open
    MonitorSampler sampler;

    const Monitor& light() const { return scene.monitors[monitor]; }
    double largest_clearance() const;
};

MonitorSetup set_up(const Scene& scene, const RayScene& rays, const Silhouettes& silhouettes, size_t monitor,
                    const GatherSettings& settings);

/// The boundary that opaque triangles that cast get where the plane at the panel's clearance cuts them: what is behind
/// it is no occluder, so the number of occluders changes there (M50). Triangles of `monitor` are left out.
Silhouettes cut_edges(const Scene& scene, const RayScene& rays, const Panel& panel, size_t monitor);

}  // namespace surimi
