// SPDX-License-Identifier: Apache-2.0
// Cosine integral over a capped cylinder in closed form, by its outline, with exact horizon clipping.
#pragma once

#include "runtime/ltc/outline.h"

namespace surimi {

/// A round cylinder with both its caps, metres; it emits outwards everywhere.
template <class T>
struct Cylinder {
    glm::vec<3, T> from{0}, to{0};  ///< middles of the caps
    T radius = 0;
};

/// What a point sees of a cylinder, relative to the point and in units of the largest distance.
enum class CylinderView { nothing, inside, cap, mantle };

template <class T>
struct SeenCylinder {
    CylinderView view = CylinderView::nothing;
    Ellipse<T> from, to;  ///< rims; where only one cap is seen, the first is its
    T tangent = 0;        ///< angle on the rims of the generators in the outline, which is the same on both sides
    T arc_from = 0, arc_to = 0;  ///< signed angles of the arcs in the outline
};

/// Which pieces make the outline of a cylinder (M13). `nothing` for a cylinder without length or radius and, with
/// FE_INVALID raised, for input that is not finite.
template <class T>
SeenCylinder<T> seen_from(const Cylinder<T>& cylinder, const glm::vec<3, T>& point) {
    using V = glm::vec<3, T>;
    SeenCylinder<T> seen;
    V a = cylinder.from - point, b = cylinder.to - point, axis = cylinder.to - cylinder.from;
    if (!is_finite(a) || !is_finite(b) || !is_finite(axis) || !std::isfinite(cylinder.radius)) return flagged(seen);
    const T scale = std::max({largest_component(a), largest_component(b), cylinder.radius}),
            axis_scale = largest_component(axis);
    if (!(cylinder.radius > 0) || !(axis_scale > 0)) return seen;
    a /= scale;
    b /= scale;
    axis = glm::normalize(axis / axis_scale);
    const T radius = cylinder.radius / scale;

    const T height_a = glm::dot(a, axis), height_b = glm::dot(b, axis);
    const V moment = glm::cross(axis, glm::dot(a, a) < glm::dot(b, b) ? a : b);
    const T distance = glm::length(moment);
    const bool sees_a = height_a > 0, sees_b = height_b < 0;
    if (distance <= radius) {  // only a cap is visible
        seen.view = sees_a || sees_b ? CylinderView::cap : CylinderView::inside;
        const glm::mat<3, 3, T> frame = frame_around(axis);
        seen.from = {sees_a ? a : b, frame[0] * radius, frame[1] * radius};
        return seen;
    }
    const V u = glm::cross(axis, moment) / distance, v = glm::cross(axis, u);  // u: from the axis towards the point
    seen.view = CylinderView::mantle;
    seen.tangent = std::atan2(std::sqrt((distance - radius) * (distance + radius)), radius);
    seen.from = {a, radius * u, radius * v};
    seen.to = {b, radius * u, radius * v};
    // Of a cap that is visible the far arc is outline, of one that is not the near arc.
    const T near = 2 * seen.tangent, far = near - T(2 * pi);
    seen.arc_to = sees_b ? far : near;
    seen.arc_from = sees_a ? -far : -near;
    return seen;
}

/// Adds the outline of a cylinder whose mantle is seen to an OutlineAbove or OutlineInLobe.
template <class T, class Outline>
void add_outline(Outline& outline, const SeenCylinder<T>& seen) {
    const T t = seen.tangent;
    add_segment(outline, point_at(seen.from, -t), point_at(seen.to, -t));
    add_arc(outline, seen.to, -t, seen.arc_to);
    add_segment(outline, point_at(seen.to, t), point_at(seen.from, t));
    add_arc(outline, seen.from, t, seen.arc_from);
}

/// Irradiance, at unit radiance, that a capped cylinder sends to a point with a given unit normal, in [0, pi] (M13).
/// pi for a point in it or on it, 0 for a cylinder without length or radius. Input that is not finite gives 0 and
/// raises FE_INVALID.
template <class T>
T irradiance_of_cylinder(const Cylinder<T>& cylinder, const glm::vec<3, T>& point, const glm::vec<3, T>& normal) {
    if (!is_finite(normal)) return flagged(T(0));
    const SeenCylinder<T> seen = seen_from(cylinder, point);
    const Ellipse<T>& cap = seen.from;
    switch (seen.view) {
        case CylinderView::nothing:
            return 0;
        case CylinderView::inside:
            return T(pi);
        case CylinderView::cap:
            return irradiance_of_cone(cone_around<T>(cap.centre, {cap.half_u, cap.half_v, glm::vec<3, T>(0)}), normal);
        case CylinderView::mantle:
            break;
    }
    OutlineAbove<T> outline;
    outline.normal = normal;
    add_outline(outline, seen);
    return irradiance_above(outline);
}

}  // namespace surimi
