// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/camera.h"

#include <cmath>

namespace surimi {

View look_at(const Vec3& eye, const Vec3& target, double yfov) {
    View view;
    view.eye = eye;
    view.yfov = yfov;
    view.forward = normalize_or(target - eye, {0, 0, -1});
    const Vec3 upwards = std::abs(view.forward.y) < 0.999 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
    view.right = normalize_or(glm::cross(view.forward, upwards), {1, 0, 0});
    view.up = glm::cross(view.right, view.forward);
    return view;
}

View view_of(const Camera& camera) {
    const Mat4& m = camera.to_world;
    View view = look_at(Vec3(m[3]), Vec3(m[3]) - Vec3(m[2]), camera.yfov);
    view.right = normalize_or(Vec3(m[0]) - view.forward * glm::dot(Vec3(m[0]), view.forward), view.right);
    view.up = glm::cross(view.right, view.forward);
    return view;
}

Vec3 ray_direction(const View& view, double x, double y, double aspect) {
    const double half = std::tan(0.5 * view.yfov);
    return view.forward + (2 * x - 1) * half * aspect * view.right + (1 - 2 * y) * half * view.up;
}

}  // namespace surimi
