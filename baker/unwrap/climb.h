// SPDX-License-Identifier: Apache-2.0
// Higher and higher densities, by plans that learn from their failures.
#pragma once

#include <cmath>
#include <optional>

#include "baker/unwrap/attempt.h"

namespace surimi {

struct ClimbLimits {
    double start = 0;           ///< density of the first attempt
    double lowest = 0;          ///< of the last one, when all others fail
    double highest = INFINITY;  ///< none is tried above it
    uint64_t most_work = 0;     ///< Occupancy::work, about nanoseconds, before it settles
};

/// The densest layout that is found, to within 0.3 % of what the same plans can do; nothing when the charts do not even
/// fit at the lowest density. Goes down from the start until they fit, halves the gap to what failed, and spends the
/// work that is left on small steps up, for which charts that found no place move forward in their plan's order. Maps
/// above 1024 texels are climbed on a smaller copy first, from which the orders and the poses are taken.
std::optional<Layout> climb(const PackTask& task, const ClimbLimits& limits);

}  // namespace surimi
