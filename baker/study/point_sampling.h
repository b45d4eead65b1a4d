// SPDX-License-Identifier: Apache-2.0
// Visibility by sampling pairs of points, one on the texel's surface, one on the monitor: from worst to best known.
#pragma once

#include <array>
#include <span>

#include "baker/study/receiver.h"

namespace surimi {

/// Points of the four-dimensional Sobol sequence: the first two numbers for the texel, the last two for the monitor.
using SobolPoints = std::span<const std::array<uint32_t, 4>>;

/// `count` independent pairs, even over both areas. Error: count^-1/2.
StudyEstimate random_points(const Receiver& receiver, int count);

/// Jittered: n x n cells of the monitor and as many of the texel, paired at random, n the root of `count` rounded down
/// (Cook 1986). Error: about count^-3/4.
StudyEstimate stratified_points(const Receiver& receiver, int count);

/// All of `points`, Owen-scrambled by the receiver's key.
StudyEstimate sobol_points(const Receiver& receiver, SobolPoints points);

/// The first sixteen of `points`; the others only where those sixteen do not agree, as Godot's lightmapper spares
/// itself rays (lm_compute.glsl: shadowing_rays_check_penumbra_denom). Misses whatever hides less than a sixteenth.
StudyEstimate probe_and_refine(const Receiver& receiver, SobolPoints points);

}  // namespace surimi
