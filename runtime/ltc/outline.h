// SPDX-License-Identifier: Apache-2.0
// The outline of a convex light, in segments and elliptic arcs, cut at one horizon or at two.
#pragma once

#include "runtime/ltc/ellipse.h"
#include "runtime/ltc/polygon.h"

namespace surimi {

/// The part of a convex outline above the horizon of `normal`, and twice its irradiance. The outline turns
/// counter-clockwise about the directions it encloses and comes in pieces, each beginning where the last one ended.
template <class T>
struct OutlineAbove {
    glm::vec<3, T> normal{0};
    T sum = 0;
    glm::vec<3, T> first{0}, last{0};  ///< ends of what has been added
    bool is_begun = false;
};

/// The same in the space of a lobe: cut at the true horizon, closed along it, brought into the space where the lobe is
/// a clamped cosine, and cut at the horizon there (M17).
template <class T>
struct OutlineInLobe {
    glm::mat<3, 3, T> to_cosine{1};
    glm::vec<3, T> normal{0};          ///< of the true horizon
    OutlineAbove<T> above;             ///< in the cosine's space
    glm::vec<3, T> first{0}, last{0};  ///< ends of what has been added, before the transformation
    bool is_begun = false;
};

/// Cuts off what of the segment is below the horizon of `normal` (M4); false when nothing is left.
template <class T>
bool cut_segment(const glm::vec<3, T>& normal, glm::vec<3, T>& a, glm::vec<3, T>& b) {
    const T height_a = glm::dot(a, normal), height_b = glm::dot(b, normal);
    if (height_a < 0 && height_b < 0) return false;
    if (height_a < 0 || height_b < 0) (height_a < 0 ? a : b) = horizon_crossing<T>({a, height_a}, {b, height_b});
    return true;
}

/// The point of an ellipse at an angle.
template <class T>
glm::vec<3, T> point_at(const Ellipse<T>& ellipse, T angle) {
    return ellipse.centre + std::cos(angle) * ellipse.half_u + std::sin(angle) * ellipse.half_v;
}

/// An ellipse under a linear map: an ellipse with the same angles.
template <class T>
Ellipse<T> operator*(const glm::mat<3, 3, T>& matrix, const Ellipse<T>& ellipse) {
    return {matrix * ellipse.centre, matrix * ellipse.half_u, matrix * ellipse.half_v};
}

/// Calls visit(from, to), in the order of the arc, for its parts that are not below the horizon of `normal`. The arc
/// begins at the ellipse's angle `start` and runs over the signed angle `angle`, at most 2 pi; parts are at most half a
/// turn long, because the ends of a whole turn do not tell it from none.
template <class T, class Visit>
void visit_arc_above(const glm::vec<3, T>& normal, const Ellipse<T>& ellipse, T start, T angle, const Visit& visit) {
    const T sense = std::copysign(T(1), angle);
    const T c = glm::dot(normal, ellipse.centre);
    const T x = glm::dot(normal, ellipse.half_u), y = glm::dot(normal, ellipse.half_v);
    std::array<T, 4> ends = {0, std::abs(angle), std::abs(angle), std::abs(angle)};  // from the start, ascending
    if (const T swing = std::hypot(x, y); swing > std::abs(c)) {
        const T middle = std::atan2(y, x), half = std::atan2(std::sqrt((swing - c) * (swing + c)), -c);
        for (size_t i = 1; i < 3; ++i) {
            const T offset = sense * (middle + (i == 1 ? -half : half) - start) / T(2 * pi);
            ends[i] = std::min(ends[i], (offset - std::floor(offset)) * T(2 * pi));
        }
        if (ends[2] < ends[1]) std::swap(ends[1], ends[2]);
    }
    for (size_t i = 0; i < 3; ++i) {
        const T from = start + sense * ends[i], to = start + sense * ends[i + 1], middle = (from + to) / 2;
        if (!(ends[i + 1] > ends[i]) || c + x * std::cos(middle) + y * std::sin(middle) < 0) continue;
        if (ends[i + 1] - ends[i] > T(pi)) {
            visit(from, middle);
            visit(middle, to);
        } else {
            visit(from, to);
        }
    }
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
    if (!cut_segment(outline.normal, a, b)) return;
    join(outline, a);
    outline.sum += edge_integral(a, b, outline.normal);
    outline.last = b;
}

/// Adds the arc of the ellipse that begins at its angle `start` and runs over the signed angle `angle`, at most 2 pi.
template <class T>
void add_arc(OutlineAbove<T>& outline, const Ellipse<T>& ellipse, T start, T angle) {
    const EllipticCone<T> cone = cone_around<T>(ellipse.centre, {ellipse.half_u, ellipse.half_v, glm::vec<3, T>(0)});
    visit_arc_above(outline.normal, ellipse, start, angle, [&](T from, T to) {
        const glm::vec<3, T> p = point_at(ellipse, from), q = point_at(ellipse, to);
        join(outline, p);
        outline.sum += arc_integral(cone, outline.normal, p, q, std::copysign(to - from, angle * cone.side));
        outline.last = q;
    });
}

/// Irradiance of a whole outline, in [0, pi].
template <class T>
T irradiance_above(OutlineAbove<T>& outline) {
    if (outline.is_begun) join(outline, outline.first);
    return outline.sum > 0 ? std::min(outline.sum / 2, T(pi)) : T(0);
}

/// Goes on at p, along the true horizon where the outline was below it.
template <class T>
void join(OutlineInLobe<T>& outline, const glm::vec<3, T>& p) {
    if (!outline.is_begun) outline.first = p;
    if (outline.is_begun && outline.last != p)
        add_segment(outline.above, outline.to_cosine * outline.last, outline.to_cosine * p);
    outline.is_begun = true;
}

template <class T>
void add_segment(OutlineInLobe<T>& outline, glm::vec<3, T> a, glm::vec<3, T> b) {
    if (!cut_segment(outline.normal, a, b)) return;
    join(outline, a);
    add_segment(outline.above, outline.to_cosine * a, outline.to_cosine * b);
    outline.last = b;
}

template <class T>
void add_arc(OutlineInLobe<T>& outline, const Ellipse<T>& ellipse, T start, T angle) {
    visit_arc_above(outline.normal, ellipse, start, angle, [&](T from, T to) {
        join(outline, point_at(ellipse, from));
        add_arc(outline.above, outline.to_cosine * ellipse, from, to - from);
        outline.last = point_at(ellipse, to);
    });
}

/// Irradiance in the cosine's space, pi times the lobe's share above the true horizon, in [0, pi].
template <class T>
T irradiance_above(OutlineInLobe<T>& outline) {
    if (outline.is_begun) join(outline, outline.first);
    return irradiance_above(outline.above);
}

}  // namespace surimi
