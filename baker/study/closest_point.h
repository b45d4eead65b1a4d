// SPDX-License-Identifier: Apache-2.0
// The area-light shadow of Godot's lightmapper: rays to the monitor's point next to the texel, or to a disk around it.
#pragma once

#include "baker/study/receiver.h"

namespace surimi {

/// Visibility as Godot's lightmapper has it (godotengine/godot, modules/lightmapper_rd/lm_compute.glsl at 015dffd9,
/// trace_direct_light, LIGHT_TYPE_AREA): sixteen places of the texel (Halton 2, 3) look at one point, that of the
/// monitor which is closest to the texel's middle. With `count` <= 16 and a light of size 0, that is all: sixteen rays.
/// Else each place sends count / 16 rays to a Vogel disk around that point, facing the texel, and stops half-way when
/// they agree. The disk's radius, which the user guesses in Godot, is that of a circle of the monitor's area. Every ray
/// counts the same. It does not converge to V, whatever the count.
StudyEstimate closest_point(const Receiver& receiver, int count);

/// The point of a monitor next to `point`.
LightPoint closest_point_of(const Monitor& monitor, const Vec3& point);

}  // namespace surimi
