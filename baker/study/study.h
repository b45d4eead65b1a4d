// SPDX-License-Identifier: Apache-2.0
// What accuracy costs on a scene: every technique at every setting, against an independent reference.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/study/measurement.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/parallel.h"

namespace surimi {

struct StudySettings {
    UnwrapSettings unwrap;
    size_t texels = 500;            ///< pairs of a texel and a monitor, 1 to 100,000
    size_t reference_rays = 65536;  ///< for each of them, 64 to 2^24
    uint64_t seed = 0;
};

struct Study {
    std::vector<Series> series;  ///< the baker's own first
    double reference_error = 0;  ///< RMS standard error of the references
    size_t reference_rays = 0;
    size_t texels = 0;  ///< that were measured
    size_t blocks = 0;  ///< that they lie in
    size_t lit = 0;     ///< pairs of a texel of the map and a monitor that lights it
    size_t triangles = 0;
    int width = 0, height = 0, pages = 1;
    size_t monitors = 0;
    uint64_t seed = 0;
};

/// The ids of series that others refer to.
inline constexpr const char* automatic_id = "surimi";
inline constexpr const char* random_id = "random";

/// Unwraps, chooses texels, traces references on all threads and measures on one. Values depend on scene and settings
/// alone, times on the machine; a series ends with the first setting that takes longer than half a minute. Sets and
/// restores the thread count. Throws what unwrap throws, Error(nothing_to_bake) when no monitor lights any texel, and
/// Error(interrupted).
Study study(const Scene& scene, const StudySettings& settings, const Progress& progress);

}  // namespace surimi
