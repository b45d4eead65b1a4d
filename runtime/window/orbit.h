// SPDX-License-Identifier: Apache-2.0
// How a hand moves the camera. Nothing here reconstructs angles, so a view goes on from exactly where it is, rolled
// cameras and straight looks down included.
#pragma once

#include "runtime/preview/camera.h"

namespace surimi {

/// Turns eye and look about `pivot`: by `yaw` about the world's +y, then by `pitch` (up is positive) about the
/// picture's horizontal; radians, of any size. Stops short of looking straight up or down. Its own eye as pivot: looks
/// around. Angles that are not finite count as 0.
View orbited(const View& view, const Vec3& pivot, double yaw, double pitch);

/// Moves the eye along the picture's right, up and forward; metres.
View moved(const View& view, const Vec3& by);

/// Brings the eye to `factor` of its distance from `pivot`, and no nearer than `nearest` metres; `factor` > 0.
View zoomed(const View& view, const Vec3& pivot, double factor, double nearest);

}  // namespace surimi
