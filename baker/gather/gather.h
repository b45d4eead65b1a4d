// SPDX-License-Identifier: Apache-2.0
// Texels -> shadowed and unshadowed irradiance from one monitor.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/texel/texels.h"
#include "runtime/base/image.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/scene.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

struct GatherSettings {
    int samples = 256;  ///< rays for each texel and monitor that can see each other, at least 1
    uint64_t seed = 0;
};

/// Texel averages at unit radiance. 0 <= shadowed <= unshadowed <= pi.
struct IrradianceEstimate {
    float unshadowed = 0;  ///< E (M1), closed form
    float shadowed = 0;    ///< S (M2)
    float error = 0;       ///< standard error of the visibility S / E, estimated from the samples
};

struct Gathered {
    std::vector<IrradianceEstimate> estimates;  ///< one for each of Texels::texels
    size_t rays = 0;
};

/// Irradiance that `scene.monitors[monitor]` sends to every texel. Texels that it cannot light (all points behind the
/// monitor or with the monitor below the horizon) get zeros and cost no ray. Each texel's random numbers depend on its
/// page and index, the monitor's channel and the seed alone.
Gathered gather(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays, size_t monitor,
                const GatherSettings& settings, const Progress& progress);

}  // namespace surimi
