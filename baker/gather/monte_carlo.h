// SPDX-License-Identifier: Apache-2.0
// Visibility of a monitor from a texel's surface by rays.
#pragma once

#include <cstdint>

#include "baker/texel/texels.h"
#include "runtime/light/monitor.h"
#include "runtime/light/sample.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

struct MonteCarloTask {
    const RayScene& rays;
    const MonitorSampler& sampler;
    size_t monitor = 0;
    double clearance = 0;  ///< metres in front of the panels at which rays end (panel.h)
    double error = 0.001;  ///< standard error of V at which it may stop
    int samples = 0;       ///< exactly so many rays; 0: as many as `error` takes, at most `most_samples`
    int most_samples = 1 << 16;
    uint64_t key = 0;  ///< of the random numbers
};

struct MonteCarloEstimate {
    double visibility = 0;  ///< in [0, 1]; 0 where no sample is lit
    double error = 0;       ///< standard error of it, estimated without bias from pairs of samples in strata (M52)
    size_t rays = 0;
    bool is_lit = false;  ///< some sample has weight
};

/// The ratio estimator (M6) over Owen-scrambled Sobol points of texel surface times monitor, in rounds of doubled size.
/// Rays go through Embree sixteen at a time. Fully lit gives exactly 1.
MonteCarloEstimate monte_carlo(const MonteCarloTask& task, const TexelSurface& surface);

}  // namespace surimi
