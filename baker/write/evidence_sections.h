// SPDX-License-Identifier: Apache-2.0
// The members of the manifest that say how a bake found its values, and how sure they are.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "baker/bake.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// By channel: mean, root mean square and maximum of the estimated standard error of V over the covered texels.
nlohmann::ordered_json error_section(const Scene& scene, const Bake& bake);

/// By channel: the promise and whether it is kept; the histogram of the estimates (`below` has the upper ends of the
/// bins; the first is for exact values); texels, points and rays by method; what blocks and points met; jumps at seams
/// before and after; the audit, if there was one, with its 95 % interval. Nothing here depends on the machine or the
/// number of threads.
nlohmann::ordered_json evidence_section(const Scene& scene, const Bake& bake);

/// By channel: CPU seconds of queries and of each method that was used, and its microseconds a point.
nlohmann::ordered_json monitor_seconds_section(const Scene& scene, const Bake& bake);

}  // namespace surimi
