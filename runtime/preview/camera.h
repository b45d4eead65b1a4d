// SPDX-License-Identifier: Apache-2.0
// Where a picture is taken from.
#pragma once

#include <string>

#include "runtime/scene/scene.h"

namespace surimi {

/// A pinhole camera; the vectors are unit and right-handed: right x up = -forward.
struct View {
    Vec3 eye{0};
    Vec3 forward{0, 0, -1};
    Vec3 right{1, 0, 0};
    Vec3 up{0, 1, 0};
    double yfov = 0.9;  ///< radians, of the picture's height
    bool operator==(const View&) const = default;
};

/// The view from `eye` towards `target`, +y up (or +z where that is the direction itself).
View look_at(const Vec3& eye, const Vec3& target, double yfov);

/// The view of a camera of the scene; its node's scale does not matter.
View view_of(const Camera& camera);

/// Direction through the picture, x and y in [0, 1] from the upper left corner; not unit.
Vec3 ray_direction(const View& view, double x, double y, double aspect);

}  // namespace surimi
