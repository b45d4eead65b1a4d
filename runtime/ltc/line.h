// SPDX-License-Identifier: Apache-2.0
// Cosine integral over a line light per width, in closed form, with exact horizon clipping.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/math.h"

namespace surimi {

/// Irradiance per apparent width, at unit radiance, that the line from `from` to `to` sends to a point with a given
/// unit normal, 1/m (M12):
///     integral along the line of max(0, n.p) d / |p|^4 dl,     d: distance of the point from the line.
/// Times 2 R it is the irradiance of a cylinder without caps of radius R << d, to first order in R / d. The part below
/// the horizon is cut off (M4). A point on the line, or on its continuation, gets 0; close to it the value grows as
/// 1 / d, without bound. Input that is not finite gives 0 and raises FE_INVALID.
template <class T>
T irradiance_of_line(const glm::vec<3, T>& from, const glm::vec<3, T>& to, const glm::vec<3, T>& point,
                     const glm::vec<3, T>& normal) {
    using V = glm::vec<3, T>;
    V a = from - point, b = to - point, along = to - from;
    if (!is_finite(a) || !is_finite(b) || !is_finite(along) || !is_finite(normal)) return flagged(T(0));
    const T scale = std::max(largest_component(a), largest_component(b)), along_scale = largest_component(along);
    if (!(scale > 0) || !(along_scale > 0)) return 0;
    a /= scale;
    b /= scale;
    along /= along_scale;
    along /= glm::length(along);

    const T height_a = glm::dot(normal, a), height_b = glm::dot(normal, b);
    if (!(height_a >= 0) && !(height_b >= 0)) return 0;
    if (height_a < 0 || height_b < 0) {
        const V crossing = a * (height_b / (height_b - height_a)) - b * (height_a / (height_b - height_a));
        (height_a < 0 ? a : b) = crossing;
    }
    const V nearer = glm::dot(a, a) < glm::dot(b, b) ? a : b;
    const V moment = glm::cross(along, nearer);
    const T d = glm::length(moment);
    // Far below rounding; the fourth power of d, below, must not vanish.
    if (!(d > std::sqrt(std::sqrt(std::numeric_limits<T>::min())))) return 0;
    const T n_foot = glm::dot(normal, glm::cross(moment, along)) / d;  // of the unit vector to the line's nearest point
    const T n_along = glm::dot(normal, along);
    const T l1 = glm::dot(a, along), l2 = glm::dot(b, along), length = glm::dot(b - a, along);
    const T q = length / ((d * d + l1 * l1) * (d * d + l2 * l2));
    const T value =
        n_foot * (q * (d * d - l1 * l2) + std::atan2(d * length, d * d + l1 * l2) / d) + n_along * q * d * (l1 + l2);
    const T per_width = value / 2 / scale;
    return per_width > 0 && std::isfinite(per_width) ? per_width : T(0);
}

}  // namespace surimi
