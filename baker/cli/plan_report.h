// SPDX-License-Identifier: Apache-2.0
// A plan as people and programs read it.
#pragma once

#include <string>

#include "baker/cli/plan_truth.h"
#include "baker/plan.h"

namespace surimi {

/// Text of several lines. `comparison` may be null.
std::string plan_text(const Scene& scene, const Plan& plan, const BakeSettings& settings, const Comparison* comparison);

/// One JSON object and a line break. What differs from run to run, seconds and measured memory, stands in "run" at the
/// end; the rest depends on scene and settings alone. `settings`: JSON of the settings in effect. `comparison` may be
/// null.
std::string plan_json(const Scene& scene, const Plan& plan, const std::string& settings, const Comparison* comparison);

}  // namespace surimi
