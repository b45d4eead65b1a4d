// SPDX-License-Identifier: Apache-2.0
// Higher and higher densities, by plans that learn from their failures.
#pragma once

#include <vector>

#include "baker/unwrap/attempt.h"

namespace surimi {

struct Climb {
    std::optional<Layout> best;       ///< nothing when not even the lowest density fits
    std::vector<PackPlan> successes;  ///< plans of the best few layouts, the best first, with their poses
};

struct ClimbLimits {
    double start = 0;        ///< density of the first attempt
    double lowest = 0;       ///< below it nothing changes any more
    double fall = 0.97;      ///< factor of density until an attempt succeeds
    uint64_t most_work = 0;  ///< Occupancy::work, about nanoseconds, before it settles
};

/// Goes down from the start until the charts fit, then up in steps that grow with success and shrink with failure to
/// 0.2 %, until the work is used up.
Climb climb(const PackTask& task, std::vector<PackPlan> plans, const ClimbLimits& limits);

/// Finds good plans on a smaller copy of the map where charts are large enough for that, then climbs on the map itself.
Climb climb_coarse_to_fine(const PackTask& task, const ClimbLimits& limits);

}  // namespace surimi
