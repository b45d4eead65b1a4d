// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/orbit.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

constexpr double steepest = pi / 2 - 1e-3;  // elevation of the look, radians: a yaw still turns the picture about it

/// Turns `v` about the unit vector `axis` by `angle` radians (Rodrigues).
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1 - std::cos(angle)));
}

View turned(const View& view, const Vec3& pivot, const Vec3& axis, double angle) {
    View result = view;
    result.eye = pivot + turned(view.eye - pivot, axis, angle);
    result.forward = normalize_or(turned(view.forward, axis, angle), view.forward);
    // Orthogonal again, so that a day of turning does not skew the picture.
    const Vec3 right = turned(view.right, axis, angle);
    result.right = normalize_or(right - result.forward * glm::dot(right, result.forward), view.right);
    result.up = glm::cross(result.right, result.forward);
    return result;
}

}  // namespace

View orbited(const View& view, const Vec3& pivot, double yaw, double pitch) {
    if (!std::isfinite(yaw)) yaw = 0;
    if (!std::isfinite(pitch)) pitch = 0;
    const double elevation = std::atan2(view.forward.y, std::hypot(view.forward.x, view.forward.z));
    // A view that is already steeper may stay so, but gets no steeper.
    const double low = std::min(-steepest, elevation), high = std::max(steepest, elevation);
    pitch = std::clamp(elevation + pitch, low, high) - elevation;
    return turned(turned(view, pivot, {0, 1, 0}, yaw), pivot, turned(view.right, {0, 1, 0}, yaw), pitch);
}

View moved(const View& view, const Vec3& by) {
    View result = view;
    result.eye += by.x * view.right + by.y * view.up + by.z * view.forward;
    return result;
}

View zoomed(const View& view, const Vec3& pivot, double factor, double nearest) {
    View result = view;
    const double distance = glm::length(view.eye - pivot);
    if (!(distance > 0) || !(factor > 0)) return result;
    const double wanted = std::max(distance * factor, std::min(distance, nearest));
    result.eye = pivot + (view.eye - pivot) * (wanted / distance);
    return result;
}

}  // namespace surimi
