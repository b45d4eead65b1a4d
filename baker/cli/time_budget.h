// SPDX-License-Identifier: Apache-2.0
// --time S: the error that a bake can reach in so many seconds.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "baker/cli/options.h"

namespace surimi {

inline constexpr double loosest_error = 0.05;     ///< beyond it a map is of no use
inline constexpr double tightest_error = 0.0005;  ///< an eighth of a step of an 8-bit map

struct ErrorCost {
    double error = 0;
    double seconds = 0;
};

struct ErrorChoice {
    ErrorCost chosen;  ///< the error has two digits
    bool fits = true;  ///< false: not even the loosest does, and that is what was chosen
};

/// The smallest error within the limits above whose cost is within `seconds`. `costs`: measured ones from loose to
/// tight, at least one, the first at the loosest error; between two the logarithms of error and seconds are taken as
/// linear, and none tighter than the last is chosen. A tighter error counts at least as many seconds as a looser one.
ErrorChoice choose_error(std::span<const ErrorCost> costs, double seconds);

/// Measures from the loosest error to the tightest, until one costs more than `seconds`.
std::vector<ErrorCost> measure_costs(const std::function<double(double error)>& seconds_at, double seconds);

/// Sets config.bake.gather.error so that all that is still to be done fits in what is left of config.seconds, by
/// calibration on this machine, and returns a line that says what was chosen. Throws what plan() throws.
std::string spend(const Scene& scene, Config& config, const Progress& progress);

}  // namespace surimi
