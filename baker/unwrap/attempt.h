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

/// With mips, masks count texels of the last level, and charts lie at multiples of them: one of them free between two
/// charts is then both enough and needed for no texel of any level to be touched by two charts. (Where charts lie
/// anywhere, it takes 2^(mips + 1) - 1 texels of gutter.) Throws Error(usage) when the map is no multiple of 2^mips.
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

/// The same by the plans of first_plans, without learning.
std::optional<Layout> try_once(const PackTask& task, double density);

/// The orders that win most often.
std::vector<PackPlan> first_plans();

}  // namespace surimi
