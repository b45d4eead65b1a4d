// SPDX-License-Identifier: Apache-2.0
// The elliptic cone of directions in which a point sees an ellipse or an ellipsoid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/ltc/eigen.h"

namespace surimi {

/// Directions d with (d.x / a)^2 + (d.y / b)^2 <= d.z^2 and d.z > 0 in the frame of its principal axes.
template <class T>
struct EllipticCone {
    glm::mat<3, 3, T> axes{1};  ///< columns x, y, z; right-handed; z points into the cone
    T a = 0, b = 0;             ///< half widths at z = 1, a >= b >= 0; both 0 where there is nothing to see
    T side = 0;                 ///< sign: > 0 where the first two half axes turn counter-clockwise about z
    bool is_inside = false;     ///< the point lies in the ellipsoid; there is no cone
};

/// An orthonormal right-handed frame (columns) whose third axis is the unit vector `z`.
template <class T>
glm::mat<3, 3, T> frame_around(const glm::vec<3, T>& z) {
    using V = glm::vec<3, T>;
    const T x = std::abs(z.x), y = std::abs(z.y), w = std::abs(z.z);
    const V away = x <= y && x <= w ? V(1, 0, 0) : y <= w ? V(0, 1, 0) : V(0, 0, 1);
    const V first = glm::normalize(glm::cross(away, z));
    return {first, glm::cross(z, first), z};
}

/// The cone around the ellipsoid with this centre, relative to the point that looks, and these three half axes, of any
/// lengths and angles (conjugate half-diameters). With a third axis of 0 it is the planar ellipse of the first two
/// (M10). Widths above 1 / epsilon, where the cone is a half space but for rounding, are cut to it. Input that is not
/// finite gives the cone of nothing and raises FE_INVALID.
template <class T>
EllipticCone<T> cone_around(glm::vec<3, T> centre, std::array<glm::vec<3, T>, 3> half_axes) {
    using V = glm::vec<3, T>;
    EllipticCone<T> cone;
    T scale = 0;
    for (const V& v : {centre, half_axes[0], half_axes[1], half_axes[2]}) {
        if (!is_finite(v)) return flagged(cone);
        scale = std::max({scale, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    }
    if (!(scale > 0)) return cone;
    centre /= scale;
    for (V& v : half_axes) v /= scale;

    const std::array<V, 3> cofactor = {glm::cross(half_axes[1], half_axes[2]), glm::cross(half_axes[2], half_axes[0]),
                                       glm::cross(half_axes[0], half_axes[1])};
    const V q(glm::dot(cofactor[0], centre), glm::dot(cofactor[1], centre), glm::dot(cofactor[2], centre));
    const T volume = std::abs(glm::dot(half_axes[0], cofactor[0]));
    const T distance = std::hypot(q.x, q.y, q.z);
    cone.side = q.z;
    cone.is_inside = volume > 0 && distance <= volume;
    const T radius = std::hypot(centre.x, centre.y, centre.z);
    if (cone.is_inside || !(radius > 0)) return cone;
    const T root = std::sqrt(distance - volume) * std::sqrt(distance + volume);  // sqrt(-det M), no cancellation

    // In a frame along the centre the matrix of a small light is graded, and Jacobi keeps the digits of its size.
    const glm::mat<3, 3, T> frame = frame_around(centre / radius);
    glm::mat<3, 3, T> m(0);
    for (const V& v : half_axes) {
        const V w(glm::dot(v, frame[0]), glm::dot(v, frame[1]), glm::dot(v, frame[2]));
        m += glm::outerProduct(w, w);
    }
    m[2][2] -= radius * radius;
    const SymmetricEigen<T> eigen = eigen_of_symmetric(m);
    const T m1 = eigen.values[0];
    T m2 = eigen.values[1], m3 = -eigen.values[2];
    const T larger = std::max(m2, m3);
    if (!(m1 > 0) || !(larger > 0)) return cone;
    // The smaller of m2 and m3 is lost in the rounding of the others; the determinant knows it.
    (m2 < m3 ? m2 : m3) = (root / m1) * (root / larger);
    if (!(m3 > 0)) return cone;
    constexpr T widest = 1 / std::numeric_limits<T>::epsilon();
    cone.a = std::min(std::sqrt(m1 / m3), widest);
    cone.b = std::min(std::sqrt(m2 / m3), cone.a);
    cone.axes = frame * eigen.axes;
    // Both the centre and the normal of the contour's plane lie on the cone's side; the clearer of the two decides.
    const V plane = q.x * cofactor[0] + q.y * cofactor[1] + q.z * cofactor[2];
    const T length = std::hypot(plane.x, plane.y, plane.z);
    const T by_centre = eigen.axes[2].z, by_plane = length > 0 ? glm::dot(cone.axes[2], plane) / length : T(0);
    if ((std::abs(by_centre) > std::abs(by_plane) ? by_centre : by_plane) < 0) {
        cone.axes[1] = -cone.axes[1];
        cone.axes[2] = -cone.axes[2];
    }
    return cone;
}

}  // namespace surimi
