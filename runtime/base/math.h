// SPDX-License-Identifier: Apache-2.0
// GLM under the names that Surimi uses. Geometry is double; what is stored in files and images is float.
#pragma once

#include <algorithm>
#include <cfenv>
#include <cmath>

#include <glm/glm.hpp>

namespace surimi {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat3 = glm::dmat3;
using Mat4 = glm::dmat4;
using Vec2f = glm::vec2;
using Vec3f = glm::vec3;
using Vec4f = glm::vec4;

inline constexpr double pi = 3.14159265358979323846;

/// The largest of the components' sizes.
template <class T>
T largest_component(const glm::vec<3, T>& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// `v` scaled to length 1, or `fallback` where `v` is zero or not finite. The scale by the largest component keeps
/// lengths from 1e-300 to 1e300 from under- or overflowing when squared.
inline Vec3 normalize_or(const Vec3& v, const Vec3& fallback) {
    const double scale = largest_component(v);
    if (!(scale > 0) || !std::isfinite(scale)) return fallback;
    const Vec3 scaled = v / scale;
    return scaled / glm::length(scaled);
}

template <class T>
bool is_finite(const glm::vec<3, T>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// `result`, with the floating-point exception flag FE_INVALID raised: what a function of the runtime returns when its
/// input is not finite. So results are always defined, and who clears the flag before a picture and tests it after
/// (std::feclearexcept, std::fetestexcept; one flag a thread) knows whether something was not. Finite input leaves the
/// flag alone.
template <class R>
R flagged(R result) {
    std::feraiseexcept(FE_INVALID);
    return result;
}

/// From a point to the segment from a to b; a and b may be one place.
inline double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 edge = b - a;
    const double length2 = glm::dot(edge, edge);
    const double at = length2 > 0 ? std::clamp(glm::dot(point - a, edge) / length2, 0.0, 1.0) : 0;
    return glm::length(point - (a + at * edge));
}

/// Luminance of a linear colour, Rec. 709.
inline double luminance(const Vec3& color) {
    return glm::dot(color, Vec3(0.2126, 0.7152, 0.0722));
}

/// Twice the area times the unit normal of the triangle a, b, c (counter-clockwise seen from its front).
inline Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    return glm::cross(b - a, c - a);
}

}  // namespace surimi
