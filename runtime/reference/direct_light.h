// SPDX-License-Identifier: Apache-2.0
// Direct light of monitors by brute force: the truth that analytic shading is held against.
#pragma once

#include "runtime/light/lit_monitor.h"
#include "runtime/light/sample.h"
#include "runtime/material/brdf.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Radiance, in nits, that a point reflects to the eye of one monitor's light: all of it, and what arrives.
struct DirectLight {
    Parts unshadowed;
    Parts shadowed;
};

/// Unbiased estimate from `samples` points on the monitor and as many directions by the BRDF, with the balance
/// heuristic (M31; Veach and Guibas 1995), for the BRDF of M30. Scrambled by `key`: two keys give independent
/// estimates. Rays are traced only where `wants_shadows`; else `shadowed` is `unshadowed`. `sampler` is of the same
/// monitor.
DirectLight direct_light(const Scene& scene, const RayScene& rays, size_t monitor, const LitMonitor& light,
                         const MonitorSampler& sampler, const ShadingPoint& point, int samples, bool wants_shadows,
                         uint64_t key);

}  // namespace surimi
