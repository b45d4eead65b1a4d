// SPDX-License-Identifier: Apache-2.0
// What a study says: which technique reaches an error first, and which setting to bake with.
#pragma once

#include <optional>
#include <string>

#include "baker/study/study.h"

namespace surimi {

/// CPU seconds for each texel at which a series first reaches an RMSE, between two settings along the straight line of
/// the logarithms; empty when none of its settings does. Nothing is extrapolated.
std::optional<double> seconds_at(const Series& series, double rmse);

/// The least RMSE of a series; infinite without points.
double least_rmse(const Series& series);

/// The largest error that is invisible: one step of an 8-bit map.
inline constexpr double visible_error = 0.004;

/// What more accuracy than `visible_error` may cost: half as much again.
inline constexpr double worthwhile_cost = 1.5;

struct Recommendation {
    Measurement measurement;  ///< its value is the --error to bake with
    double map_seconds = 0;   ///< CPU seconds of one core for all texels and monitors of the map
    bool is_kept = true;      ///< RMSE within half the error, and all texels but 0.1 % within it
};

/// Of the baker's automatic settings: from the loosest that is no looser than `visible_error` and keeps its promise on,
/// the finest that keeps it as well and costs at most `worthwhile_cost` times as much. When none keeps it, the finest
/// of all. Throws Error(internal) when the study has no automatic settings.
Recommendation recommend(const Study& study);

/// One paragraph in words. `file_name` is the scene's, for the command to paste.
std::string reading(const Study& study, const std::string& file_name);

}  // namespace surimi
