// SPDX-License-Identifier: Apache-2.0
// Cosine integral over a polygon: Lambert's formula with exact horizon clipping.
#pragma once

#include <cmath>
#include <span>

#include "runtime/base/math.h"

namespace surimi {

/// Irradiance, at unit radiance, that a planar polygon sends to a point with a given normal, in [0, pi] (M1):
///     E = 1/2 sum_i angle_i (n . unit(a_i x a_i+1)),   angle_i = atan2(|a_i x a_i+1|, a_i . a_i+1),
/// Lambert 1760; the angle by atan2 because acos of the cosine is 2 % off for an edge of 2e-3 rad. The part below the
/// horizon is cut off edge by edge: an edge that crosses it contributes the part above, and one more edge closes the
/// contour along the horizon, from where it left to where it came back (M4). No vertex list is made.
/// Corners run counter-clockwise seen from the side that emits; a point on the other side gets 0, or the same
/// irradiance as in front of it when `two_sided`. Points in the polygon's plane get 0 outside it.
/// Never NaN for finite input; the result does not change when everything is scaled or shifted together.
template <class T>
T irradiance_of_polygon(std::span<const glm::vec<3, T>> corners, const glm::vec<3, T>& point,
                        const glm::vec<3, T>& normal, bool two_sided = false) {
    using V = glm::vec<3, T>;
    // n . unit(a x b) * angle(a, b): one edge's share of the vector irradiance along the normal.
    const auto edge = [&](const V& a, const V& b) {
        // a x b by the edge and its nearer end: of two nearly equal vectors only noise would be left.
        const V c = glm::cross(glm::dot(a, a) < glm::dot(b, b) ? a : b, b - a);
        const T sine = glm::length(c);
        return sine > 0 ? std::atan2(sine, glm::dot(a, b)) * (glm::dot(c, normal) / sine) : T(0);
    };
    T sum = 0;
    V left{0}, entered{0};  // where the contour goes below the horizon, and where it comes back
    bool is_clipped = false;
    V a = corners[corners.size() - 1] - point;
    T height_a = glm::dot(a, normal);
    for (const V& corner : corners) {
        const V b = corner - point;
        const T height_b = glm::dot(b, normal);
        if (height_a >= 0 && height_b >= 0) {
            sum += edge(a, b);
        } else if (height_a >= 0 || height_b >= 0) {
            const V crossing = a * (height_b / (height_b - height_a)) - b * (height_a / (height_b - height_a));
            is_clipped = true;
            if (height_a >= 0) {
                sum += edge(a, crossing);
                left = crossing;
            } else {
                sum += edge(crossing, b);
                entered = crossing;
            }
        }
        a = b;
        height_a = height_b;
    }
    if (is_clipped) {  // along the horizon, where the normal of every edge is +-n
        const V c = glm::cross(left, entered);
        const T sine = glm::length(c), cosine = glm::dot(left, entered);
        // Both are 0 for a corner at the point; atan2(0, -0) would be pi.
        if (sine > 0 || cosine < 0) sum += std::copysign(std::atan2(sine, cosine), glm::dot(c, normal));
    }
    // Seen from the front, counter-clockwise corners circle the direction to the polygon clockwise.
    const T irradiance = -sum / 2;
    const T value = two_sided ? std::abs(irradiance) : irradiance;
    return value > 0 ? std::min(value, T(pi)) : T(0);
}

}  // namespace surimi
