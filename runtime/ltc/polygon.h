// SPDX-License-Identifier: Apache-2.0
// Cosine integral over a polygon: Lambert's formula with exact horizon clipping.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "runtime/base/math.h"

namespace surimi {

/// n . unit(a x b) * angle(a, b): the share of the edge from a to b in the contour integral along `normal`, twice its
/// irradiance (M1). 0 for an edge without length, aimed at the point or beginning there.
template <class T>
T edge_integral(const glm::vec<3, T>& a, const glm::vec<3, T>& b, const glm::vec<3, T>& normal) {
    // a x b by the edge and its nearer end: of two nearly equal vectors only noise would be left.
    const glm::vec<3, T> c = glm::cross(glm::dot(a, a) < glm::dot(b, b) ? a : b, b - a);
    const T sine = glm::length(c);
    return sine > 0 ? std::atan2(sine, glm::dot(a, b)) * (glm::dot(c, normal) / sine) : T(0);
}

/// A place relative to the point, and its height above a horizon.
template <class T>
struct Elevated {
    glm::vec<3, T> place{0};
    T height = 0;
};

/// Where the line through a and b, whose heights have different signs, meets the horizon (M4).
template <class T>
glm::vec<3, T> horizon_crossing(const Elevated<T>& a, const Elevated<T>& b) {
    return a.place * (b.height / (b.height - a.height)) - b.place * (a.height / (b.height - a.height));
}

/// Where a contour goes below a horizon and comes back.
template <class T>
struct HorizonGap {
    glm::vec<3, T> left{0};           ///< where it went below
    glm::vec<3, T> first_entered{0};  ///< where it came up for the first time, if it began below
    bool is_below = false, began_below = false;
};

/// Cuts an edge of a closed contour, whose edges come in order, at the horizon (M4). Calls add(a, b) for the part of
/// the edge above it, and close(left, entered) where the contour comes back to the horizon.
template <class T, class Add, class Close>
void cut_edge(HorizonGap<T>& gap, const Elevated<T>& a, const Elevated<T>& b, const Add& add, const Close& close) {
    if (a.height >= 0 && b.height >= 0) {
        add(a.place, b.place);
    } else if (a.height >= 0) {
        gap.left = horizon_crossing(a, b);
        gap.is_below = true;
        add(a.place, gap.left);
    } else if (b.height >= 0) {
        const glm::vec<3, T> entered = horizon_crossing(a, b);
        if (gap.is_below) {
            close(gap.left, entered);
            gap.is_below = false;
        } else {
            gap.first_entered = entered;
            gap.began_below = true;
        }
        add(entered, b.place);
    }
}

/// Closes a contour that began and ended below the horizon.
template <class T, class Close>
void close_gap(const HorizonGap<T>& gap, const Close& close) {
    if (gap.is_below && gap.began_below) close(gap.left, gap.first_entered);
}

/// The contour integral of a polygon with what is below the horizon cut off.
template <class T>
struct PolygonAbove {
    glm::vec<3, T> normal{0};
    T sum = 0;
    T along_horizon = 0;  ///< of the edges that close the contour
    HorizonGap<T> gap;
};

/// Adds what a contour that is below the horizon between two places has along the horizon, where the normal of every
/// edge is +-n.
template <class T>
void close_along_horizon(PolygonAbove<T>& polygon, const glm::vec<3, T>& left, const glm::vec<3, T>& entered) {
    const glm::vec<3, T> c = glm::cross(left, entered);
    const T sine = glm::length(c), cosine = glm::dot(left, entered);
    // Both are 0 for a corner at the point; atan2(0, -0) would be pi.
    if (sine > 0 || cosine < 0)
        polygon.along_horizon += std::copysign(std::atan2(sine, cosine), glm::dot(c, polygon.normal));
}

/// Adds the next edge, from a to b.
template <class T>
void add_edge(PolygonAbove<T>& polygon, const Elevated<T>& a, const Elevated<T>& b) {
    using V = glm::vec<3, T>;
    cut_edge(
        polygon.gap, a, b, [&](const V& p, const V& q) { polygon.sum += edge_integral(p, q, polygon.normal); },
        [&](const V& left, const V& entered) { close_along_horizon(polygon, left, entered); });
}

/// Irradiance in [0, pi] of a polygon whose edges have all been added (M4). It emits to the side from which its corners
/// run counter-clockwise, or to both.
template <class T>
T irradiance_above(PolygonAbove<T>& polygon, bool two_sided) {
    using V = glm::vec<3, T>;
    close_gap(polygon.gap, [&](const V& left, const V& entered) { close_along_horizon(polygon, left, entered); });
    // Seen from the front, counter-clockwise corners circle the direction to the polygon clockwise.
    const T irradiance = -(polygon.sum + polygon.along_horizon) / 2;
    const T value = two_sided ? std::abs(irradiance) : irradiance;
    return value > 0 ? std::min(value, T(pi)) : T(0);
}

/// Largest component of the corners relative to `point`; infinity when one is not finite, 0 when there are none.
template <class T>
T largest_offset(std::span<const glm::vec<3, T>> corners, const glm::vec<3, T>& point) {
    T largest = 0;
    for (const glm::vec<3, T>& corner : corners) {
        const glm::vec<3, T> offset = corner - point;
        if (!is_finite(offset)) return std::numeric_limits<T>::infinity();
        largest = std::max({largest, std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
    }
    return largest;
}

/// A power of 2 that brings numbers up to `largest` > 0 to a size whose fourth powers neither over- nor underflow; 1
/// where they do not anyway, so ordinary scenes are not touched.
template <class T>
T unit_scale(T largest) {
    using Limits = std::numeric_limits<T>;
    const int exponent = std::ilogb(largest);
    if (std::abs(exponent) < Limits::max_exponent / 5) return 1;
    return std::ldexp(T(1), std::clamp(-exponent, Limits::min_exponent, Limits::max_exponent - 1));
}

/// Irradiance, at unit radiance, that a planar polygon sends to a point with a given unit normal, in [0, pi] (M1):
///     E = 1/2 sum_i angle_i (n . unit(a_i x a_i+1)),   angle_i = atan2(|a_i x a_i+1|, a_i . a_i+1),
/// Lambert 1760; the angle by atan2 because acos of the cosine is 2 % off for an edge of 2e-3 rad. The part below the
/// horizon is cut off edge by edge: an edge that crosses it contributes the part above, and one more edge closes the
/// contour along the horizon, from where it left to where it came back (M4). No vertex list is made, and the polygon
/// need not be convex.
/// Corners run counter-clockwise seen from the side that emits; a point on the other side gets 0, or the same
/// irradiance as in front of it when `two_sided`. Points in the polygon's plane get 0 outside it; fewer than three
/// corners give 0. Never NaN; the result does not change when everything is scaled or shifted together. Input that is
/// not finite gives 0 and raises FE_INVALID.
template <class T>
T irradiance_of_polygon(std::span<const glm::vec<3, T>> corners, const glm::vec<3, T>& point,
                        const glm::vec<3, T>& normal, bool two_sided = false) {
    using V = glm::vec<3, T>;
    const T largest = largest_offset(corners, point);
    if (!std::isfinite(largest) || !is_finite(point) || !is_finite(normal)) return flagged(T(0));
    if (corners.size() < 3 || !(largest > 0)) return 0;
    const T scale = unit_scale(largest);
    PolygonAbove<T> polygon;
    polygon.normal = normal;
    const auto elevated = [&](const V& corner) -> Elevated<T> {
        const V place = (corner - point) * scale;
        return {place, glm::dot(place, normal)};
    };
    Elevated<T> a = elevated(corners[corners.size() - 1]);
    for (const V& corner : corners) {
        const Elevated<T> b = elevated(corner);
        add_edge(polygon, a, b);
        a = b;
    }
    return irradiance_above(polygon, two_sided);
}

}  // namespace surimi
