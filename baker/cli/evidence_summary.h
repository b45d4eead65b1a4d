// SPDX-License-Identifier: Apache-2.0
// How a bake found its values and how sure they are, for people.
#pragma once

#include <string>

#include "baker/bake.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// "99.91 %" for a share of 0.0009 above a limit, rounded down: 100 % are all.
std::string percent_within(double share_above);

/// Two lines on stderr for each monitor: texels by state and method; estimated errors and the audit. A third where the
/// error asked for is not reached. The manifest has all of it.
void print_evidence(const Scene& scene, const Bake& bake);

/// Throws Error(target_missed), which says why, when the promise of some monitor's channel is not kept.
void require_promises(const Scene& scene, const Bake& bake);

}  // namespace surimi
