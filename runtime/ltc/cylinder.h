// SPDX-License-Identifier: Apache-2.0
// Cosine integral over a capped cylinder in closed form, by its outline, with exact horizon clipping.
#pragma once

#include "runtime/ltc/ellipse.h"

namespace surimi {

/// A round cylinder with both its caps, metres; it emits outwards everywhere.
template <class T>
struct Cylinder {
    glm::vec<3, T> from{0}, to{0};  ///< middles of the caps
    T radius = 0;
};

/// The part of a convex outline above the horizon of `normal`, and twice its irradiance. The outline turns
/// counter-clockwise about the directions it encloses and comes in pieces, each beginning where the last one ended.
template <class T>
struct OutlineAbove {
    glm::vec<3, T> normal{0};
    T sum = 0;
    glm::vec<3, T> first{0}, last{0};  ///< ends of what has been added
    bool is_begun = false;
};

/// Goes on at p. Where the outline was below the horizon, it is closed along it, where the normal of every edge is
/// +normal (M4); where it was not, p is the last point and nothing is added.
template <class T>
void join(OutlineAbove<T>& outline, const glm::vec<3, T>& p) {
    if (!outline.is_begun) outline.first = p;
    const T sine = glm::length(glm::cross(outline.last, p)), cosine = glm::dot(outline.last, p);
    if (outline.is_begun && (sine > 0 || cosine < 0)) outline.sum += std::atan2(sine, cosine);
    outline.is_begun = true;
}

template <class T>
void add_segment(OutlineAbove<T>& outline, glm::vec<3, T> a, glm::vec<3, T> b) {
    const T height_a = glm::dot(a, outline.normal), height_b = glm::dot(b, outline.normal);
    if (height_a < 0 && height_b < 0) return;
    if (height_a < 0 || height_b < 0)
        (height_a < 0 ? a : b) = a * (height_b / (height_b - height_a)) - b * (height_a / (height_b - height_a));
    join(outline, a);
    const glm::vec<3, T> c = glm::cross(glm::dot(a, a) < glm::dot(b, b) ? a : b, b - a);
    const T sine = glm::length(c);
    if (sine > 0) outline.sum += std::atan2(sine, glm::dot(a, b)) * (glm::dot(c, outline.normal) / sine);
    outline.last = b;
}

/// Integral of n.(p x dp) / |p|^2 along an arc of the ellipse on `cone`, from p to q; `turns` is the sense about the
/// cone's axis times the arc's angle on the ellipse itself (M13).
template <class T>
T arc_integral(const EllipticCone<T>& cone, const glm::vec<3, T>& normal, const glm::vec<3, T>& p,
               const glm::vec<3, T>& q, T turns) {
    using V = glm::vec<3, T>;
    const T a = cone.a, b = cone.b;
    if (!(a > 0)) return 0;
    const V n = normal * cone.axes, p_cone = p * cone.axes, q_cone = q * cone.axes;  // transposed: into the frame
    // Sine and cosine of the place on the cone; with b = 0, the cap seen edge-on, the sine has no influence.
    const auto ratio = [](T x, T y) { return y > 0 ? std::clamp(x / y, T(-1), T(1)) : T(0); };
    const T c0 = ratio(p_cone.x, a * p_cone.z), c1 = ratio(q_cone.x, a * q_cone.z);
    const T s0 = ratio(p_cone.y, b * p_cone.z), s1 = ratio(q_cone.y, b * q_cone.z);
    const T A = std::hypot(T(1), a), B = std::hypot(T(1), b), k = std::sqrt((a - b) * (a + b));
    const auto share_x = [&](T c, T s) { return k > 0 ? std::asinh(k * s / std::hypot(B, k * c)) / k : s / B; };
    const auto share_y = [&](T c) { return k > 0 ? std::atan2(k * c, B) / k : c / B; };
    T turn = std::atan2(A * B * (c0 * s1 - s0 * c1), A * A * c0 * c1 + B * B * s0 * s1);
    // Rounding may turn an arc of no length backwards; that is not a whole turn.
    const bool is_short = std::abs(turns) < T(pi) && std::abs(turn) < std::sqrt(std::numeric_limits<T>::epsilon());
    if (turns * turn < 0 && !is_short) turn += std::copysign(T(2 * pi), turns);
    return -n.x * (b / A) * (share_x(c1, s1) - share_x(c0, s0)) + n.y * (a / B) * (share_y(c1) - share_y(c0)) +
           n.z * (a / A) * (b / B) * turn;
}

/// Adds the arc of the ellipse that begins at its angle `start` and runs over the signed angle `angle`, at most 2 pi.
template <class T>
void add_arc(OutlineAbove<T>& outline, const Ellipse<T>& ellipse, T start, T angle) {
    using V = glm::vec<3, T>;
    const auto at = [&](T t) -> V {
        return ellipse.centre + std::cos(t) * ellipse.half_u + std::sin(t) * ellipse.half_v;
    };
    const T sense = std::copysign(T(1), angle);
    const T c = glm::dot(outline.normal, ellipse.centre);
    const T x = glm::dot(outline.normal, ellipse.half_u), y = glm::dot(outline.normal, ellipse.half_v);
    std::array<T, 4> ends = {0, std::abs(angle), std::abs(angle), std::abs(angle)};  // from the start, ascending
    if (const T swing = std::hypot(x, y); swing > std::abs(c)) {
        const T middle = std::atan2(y, x), half = std::atan2(std::sqrt((swing - c) * (swing + c)), -c);
        for (size_t i = 1; i < 3; ++i) {
            const T offset = sense * (middle + (i == 1 ? -half : half) - start) / T(2 * pi);
            ends[i] = std::min(ends[i], (offset - std::floor(offset)) * T(2 * pi));
        }
        if (ends[2] < ends[1]) std::swap(ends[1], ends[2]);
    }
    const EllipticCone<T> cone = cone_around<T>(ellipse.centre, {ellipse.half_u, ellipse.half_v, V(0)});
    for (size_t i = 0; i < 3; ++i) {
        const T from = start + sense * ends[i], to = start + sense * ends[i + 1], middle = (from + to) / 2;
        if (!(ends[i + 1] > ends[i]) || c + x * std::cos(middle) + y * std::sin(middle) < 0) continue;
        const V p = at(from), q = at(to);
        join(outline, p);
        outline.sum += arc_integral(cone, outline.normal, p, q, std::copysign(to - from, sense * cone.side));
        outline.last = q;
    }
}

/// Irradiance, at unit radiance, that a capped cylinder sends to a point with a given unit normal, in [0, pi] (M13).
/// pi for a point in it or on it, 0 for a cylinder without length or radius and for input that is not finite.
template <class T>
T irradiance_of_cylinder(const Cylinder<T>& cylinder, const glm::vec<3, T>& point, const glm::vec<3, T>& normal) {
    using V = glm::vec<3, T>;
    V a = cylinder.from - point, b = cylinder.to - point, axis = cylinder.to - cylinder.from;
    const auto largest = [](const V& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    const T scale = std::max({largest(a), largest(b), cylinder.radius}), axis_scale = largest(axis);
    const bool is_finite = std::isfinite(glm::dot(a / scale, b / scale) + glm::dot(normal, normal));
    if (!is_finite || !(cylinder.radius > 0) || !(axis_scale > 0)) return 0;
    a /= scale;
    b /= scale;
    axis = glm::normalize(axis / axis_scale);
    const T radius = cylinder.radius / scale;

    const T height_a = glm::dot(a, axis), height_b = glm::dot(b, axis);
    const V moment = glm::cross(axis, glm::dot(a, a) < glm::dot(b, b) ? a : b);
    const T distance = glm::length(moment);
    const bool sees_a = height_a > 0, sees_b = height_b < 0;
    if (distance <= radius) {  // only a cap is visible
        if (!sees_a && !sees_b) return T(pi);
        const glm::mat<3, 3, T> frame = frame_around(axis);
        return irradiance_of_cone(cone_around<T>(sees_a ? a : b, {frame[0] * radius, frame[1] * radius, V(0)}), normal);
    }
    const V u = glm::cross(axis, moment) / distance, v = glm::cross(axis, u);  // u: from the axis towards the point
    const T tangent = std::atan2(std::sqrt((distance - radius) * (distance + radius)), radius);
    const Ellipse<T> cap_a{a, radius * u, radius * v}, cap_b{b, radius * u, radius * v};
    const T near = 2 * tangent, far = near - T(2 * pi);
    const auto rim = [&](const Ellipse<T>& cap, T t) -> V {
        return cap.centre + std::cos(t) * cap.half_u + std::sin(t) * cap.half_v;
    };
    // Of a cap that is visible the far arc is outline, of one that is not the near arc.
    const T arc_b = sees_b ? far : near, arc_a = sees_a ? -far : -near;
    OutlineAbove<T> outline;
    outline.normal = normal;
    add_segment(outline, rim(cap_a, -tangent), rim(cap_b, -tangent));
    add_arc(outline, cap_b, -tangent, arc_b);
    add_segment(outline, rim(cap_b, tangent), rim(cap_a, tangent));
    add_arc(outline, cap_a, tangent, arc_a);
    if (outline.is_begun) join(outline, outline.first);
    return outline.sum > 0 ? std::min(outline.sum / 2, T(pi)) : T(0);
}

}  // namespace surimi
