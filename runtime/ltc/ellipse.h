// SPDX-License-Identifier: Apache-2.0
// Cosine integral over ellipses and ellipsoids in closed form, with exact horizon clipping.
#pragma once

#include "runtime/ltc/cone.h"

namespace surimi {

/// centre + cos(s) half_u + sin(s) half_v and what is inside, metres. The half axes may have any lengths and any angle;
/// cross(half_u, half_v) points to the front, the side that emits.
template <class T>
struct Ellipse {
    glm::vec<3, T> centre{0}, half_u{0}, half_v{0};
};

/// centre + (x, y, z) . half_axes for all |(x, y, z)| <= 1, metres; half axes of any lengths and angles. It emits
/// outwards everywhere. A sphere has three half axes of its radius along x, y and z.
template <class T>
struct Ellipsoid {
    glm::vec<3, T> centre{0};
    std::array<glm::vec<3, T>, 3> half_axes{};
};

/// The part above the horizon of a cone so narrow that 1 + a^2 is taken as 1: what M11 leaves when its terms of the
/// order a, which cancel, are gone. `tilt` is hypot(n.x a, n.y b), |height| < tilt.
template <class T>
T irradiance_of_narrow_cone(T ab, T tilt, T height) {
    const T cosine = -height / tilt, sine = std::sqrt((1 - cosine) * (1 + cosine));
    const T segment = std::atan2(sine, cosine) - cosine * sine;  // its area in the unit circle
    return std::max(T(0), ab * tilt * (T(2) / 3 * sine * sine * sine - cosine * segment));
}

/// Irradiance, at unit radiance, from all directions of the cone that are above the horizon of the unit vector
/// `normal`, in [0, pi] (M11); pi where there is no cone because the point is inside. A normal that is not finite gives
/// 0 and raises FE_INVALID.
template <class T>
T irradiance_of_cone(const EllipticCone<T>& cone, const glm::vec<3, T>& normal) {
    if (!is_finite(normal)) return flagged(T(0));
    if (cone.is_inside) return T(pi);
    const T a = cone.a, b = cone.b;
    const T x = glm::dot(normal, cone.axes[0]), y = glm::dot(normal, cone.axes[1]), z = glm::dot(normal, cone.axes[2]);
    const T A = std::hypot(T(1), a), B = std::hypot(T(1), b);
    const T xa = x * a, yb = y * b;
    const T tilt = std::hypot(xa, yb);
    T sum = 0;  // the contour integral, twice the irradiance
    if (z >= tilt) {
        sum = T(2 * pi) * z * (a / A) * (b / B);
    } else if (z > -tilt) {
        if (a * a < std::sqrt(std::numeric_limits<T>::epsilon())) return irradiance_of_narrow_cone(a * b, tilt, z);
        const T xx = x * x, yy = y * y, zz = z * z, aa = a * a, bb = b * b;
        const T k = std::sqrt((a - b) * (a + b));
        const T w = std::sqrt((tilt - z) * (tilt + z));
        const T chord_sine = 2 * a * b * w, chord_cosine = aa * (xx + zz) + bb * (yy + zz) - aa * bb * (xx + yy);
        const T product = std::hypot(chord_sine, chord_cosine);  // of the distances to the two crossings
        if (!(product > 0)) return 0;                            // a cone too narrow to square
        // asinh(k u) / k and atan2(k v, w) / k: entire in k, so a round cone (k = 0) is only a limit.
        const T u = 2 * A * xa * w / product;
        const T v = 2 * B * yb * w, v_cosine = B * B * xa * xa + (1 + 2 * bb - aa) * yb * yb + k * k * zz;
        const T share_x = k > 0 ? std::asinh(k * u) / k : u;
        const T share_y = k > 0 ? std::atan2(k * v, v_cosine) / k : v / v_cosine;
        T turn = std::atan2(-2 * A * B * w * z, A * A * (zz - yb * yb) + B * B * (zz - xa * xa));
        if (z >= 0) turn += turn <= 0 ? T(2 * pi) : T(0);  // more than half of the contour is above
        sum = std::atan2(chord_sine, chord_cosine) - x * (b / A) * share_x - y * (a / B) * share_y +
              z * (a / A) * (b / B) * turn;
    }
    return sum > 0 ? std::min(sum / 2, T(pi)) : T(0);
}

/// Irradiance, at unit radiance, that an ellipse sends to a point with a given unit normal, in [0, pi] (M10, M11).
/// Exact: no sphere in its place and no table. A point behind it gets 0, or the same as in front when `two_sided`; a
/// point in its plane gets 0, as from an ellipse without area. Input that is not finite gives 0 and raises FE_INVALID.
template <class T>
T irradiance_of_ellipse(const Ellipse<T>& ellipse, const glm::vec<3, T>& point, const glm::vec<3, T>& normal,
                        bool two_sided = false) {
    if (!is_finite(normal)) return flagged(T(0));
    const EllipticCone<T> cone =
        cone_around<T>(ellipse.centre - point, {ellipse.half_u, ellipse.half_v, glm::vec<3, T>(0)});
    const bool is_seen = two_sided ? cone.side != 0 : cone.side < 0;
    return is_seen ? irradiance_of_cone(cone, normal) : T(0);
}

/// Irradiance, at unit radiance, that an ellipsoid sends to a point with a given unit normal, in [0, pi] (M10, M11).
/// pi for a point in it or on it. With one half axis of 0 it is a two-sided ellipse, with two 0. Input that is not
/// finite gives 0 and raises FE_INVALID.
template <class T>
T irradiance_of_ellipsoid(const Ellipsoid<T>& ellipsoid, const glm::vec<3, T>& point, const glm::vec<3, T>& normal) {
    return irradiance_of_cone(cone_around(ellipsoid.centre - point, ellipsoid.half_axes), normal);
}

}  // namespace surimi
