// SPDX-License-Identifier: Apache-2.0
// One density, several plans: do the charts fit?
#pragma once

#include <optional>
#include <vector>

#include "baker/unwrap/fit.h"

namespace surimi {

/// What stays the same while densities are tried.
struct PackTask {
    const FitRequest& request;
    std::vector<Outline> outlines;        ///< of each chart
    std::vector<std::vector<Vec2>> axes;  ///< of each chart: see pack_axes
    MapSize map;
    int cell = 1;    ///< texels: what masks count, and charts are placed at multiples of
    int gutter = 2;  ///< cells
};

/// With mips, everything counts in texels of the last level, which has to keep one of them between two charts: no
/// chart then shares a texel with another on any level, and more room is lost neither to a gutter that has to hold
/// for every alignment (2^(mips + 1) - 1 texels) nor to the search.
PackTask make_task(const FitRequest& request, const MapSize& map);

/// Whether a count of texels allows the charts to fit.
bool could_fit(const PackTask& task, double density);

struct Attempt {
    std::optional<Layout> layout;
    size_t winner = 0;  ///< number of the plan
    uint64_t work = 0;
};

/// A layout at this density by the first of the plans that succeeds, or nothing. All plans are tried, so that the
/// result does not depend on the threads. When told to learn, charts that found no place move forward in their plan's
/// order, for the next attempt.
Attempt attempt(const PackTask& task, double density, std::vector<PackPlan>& plans, bool is_learning);

/// The same with plans that are not needed any more, without learning.
std::optional<Layout> try_once(const PackTask& task, double density, std::vector<PackPlan> plans);

}  // namespace surimi
