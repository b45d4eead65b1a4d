// SPDX-License-Identifier: Apache-2.0
// What the methods cost, so that the cheapest that reaches the error is taken. Constants, not measurements of the day:
// the same scene has to give the same bytes. `gather_stages` prints them for the machine at hand; only ratios matter.
#pragma once

#include <cstddef>

#include "baker/gather/settings.h"

namespace surimi {

/// What the error asked for allows each step to leave.
struct Tolerances {
    double lines = 0;        ///< estimate of a point at which scanlines stop
    double footprint = 0;    ///< of a texel's average over a few points
    double monte_carlo = 0;  ///< standard error at which rays stop, where a tenth of the texels is left to them
    double all_by_rays = 0;  ///< the same where all are
    int first_lines = 64;    ///< scanlines to begin with
};
Tolerances tolerances(const GatherSettings& settings);

inline constexpr int most_lines = 1024;

/// Of one point, where so many are averaged.
struct LineLimits {
    double error = 0;  ///< estimate at which it stops
    int first = 64;    ///< lines to begin with
};
LineLimits lines_for(const Tolerances& limits, double averaged);

/// Nanoseconds for one texel or point, with the machine of docs/decisions.md.
double cost_of_projecting(size_t candidates);
double cost_of_split(size_t segments);
double cost_of_scan(size_t segments, int lines);
double cost_of_monte_carlo(double standard_error);
/// Where a texel's points differ as well: shadows that are sharper than the texel.
double cost_of_average_by_rays(double standard_error);

/// Are a block's texels left to rays because it has so many candidates, of which half are taken to be silhouettes, that
/// one point each would cost more?
bool are_rays_cheaper(size_t candidates, const GatherSettings& settings);

}  // namespace surimi
