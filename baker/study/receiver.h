// SPDX-License-Identifier: Apache-2.0
// What every technique of a study is given, and what it gives back.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/texel/texel_surface.h"
#include "runtime/light/sample.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// A monitor with what all of a study's techniques share. Scene and rays must outlive it.
struct StudiedMonitor {
    const Scene& scene;
    const RayScene& rays;
    size_t index;                   ///< of Scene::monitors
    MonitorSampler sampler;         ///< evenly by area
    std::vector<double> clearance;  ///< of each panel: metres in front of its plane within which nothing is an occluder

    StudiedMonitor(const Scene& scene, const RayScene& rays, size_t index);
    const Monitor& monitor() const { return scene.monitors[index]; }
};

/// One texel's surface under one monitor.
struct Receiver {
    const StudiedMonitor& light;
    const TexelSurface& surface;
    uint64_t key = 0;  ///< of its random numbers
};

struct StudyEstimate {
    double visibility = 0;  ///< V in [0, 1]; 0 where nothing is lit
    size_t rays = 0;        ///< traced; look-ups in a depth map are none
    bool is_lit = false;    ///< some sample had a weight
};

/// Irradiance weight of a pair of points, up to the monitor's area: cos cos / r^2; 0 below a horizon.
double transfer(const SurfacePoint& from, const LightPoint& to, bool is_two_sided);

}  // namespace surimi
