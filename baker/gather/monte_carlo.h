// SPDX-License-Identifier: Apache-2.0
// Visibility of a monitor from a texel's surface by rays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/texel/texel_surface.h"
#include "runtime/light/monitor.h"
#include "runtime/light/sample.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// What all texels share of their samples: four-dimensional Sobol points. 1 MB; make one for a bake.
struct SamplePoints {
    static constexpr size_t capacity = size_t{1} << 16;

    SamplePoints();

    /// [dimension][index]: digits of the Sobol points, reversed as scrambling wants them. Dimensions 0 and 1 choose
    /// the point of the monitor, 2 and 3 that of the texel.
    std::array<std::vector<uint32_t>, 4> digits;
};

struct MonteCarloTask {
    const RayScene& rays;
    const MonitorSampler& sampler;
    const SamplePoints& points;
    size_t monitor = 0;
    double clearance = 0;  ///< metres in front of the panels at which rays end (panel.h)
    double error = 0.001;  ///< standard error of V at which it may stop
    int samples = 0;       ///< exactly so many, at most SamplePoints::capacity; 0: as many as `error` takes
    int most_samples = SamplePoints::capacity;
    uint64_t key = 0;  ///< of the random numbers; nothing else does the result depend on
};

struct MonteCarloEstimate {
    double visibility = 0;  ///< in [0, 1]; 0 where no sample is lit
    /// Standard error of it, from the spread of eighths of the samples (M52): not below the truth on average, and never
    /// 0, since what N samples have not met may be there. 1 where no sample is lit.
    double error = 1;
    size_t rays = 0;      ///< fewer than samples where the monitor is partly behind or below the horizon
    bool is_lit = false;  ///< some sample has weight
};

/// The ratio estimator (M6) over Owen-scrambled Sobol points of texel surface times monitor, in rounds of doubled size
/// from 64. Rays go through Embree sixteen at a time. Fully lit gives exactly 1, fully shadowed exactly 0. Texels that
/// no one of 4096 samples lights are given up.
MonteCarloEstimate monte_carlo(const MonteCarloTask& task, const TexelSurface& surface);

}  // namespace surimi
