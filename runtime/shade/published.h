// SPDX-License-Identifier: Apache-2.0
// The published ways to shade with area lights, written anew from their formulae: to show what other programs show, and
// to be measured against. The tests show where they fail. Everything in a cosine's space has the point at the origin
// and the normal along z.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "runtime/base/math.h"

namespace surimi::published {

/// angle / (2 pi sin(angle)) of the angle whose cosine is x, by the rational fit of Hill and Heitz 2017, relative error
/// 1.4e-6; with the bound on sin^2 that nearly opposite directions run into.
template <class T>
T edge_weight(T x) {
    const T y = std::abs(x);
    const T above = T(0.8543985) + (T(0.4965155) + T(0.0145206) * y) * y;
    const T below = T(3.4175940) + (T(4.1616724) + y) * y;
    const T weight = above / below;
    return x > 0 ? weight : T(0.5) / std::sqrt(std::max(1 - x * x, T(1e-7))) - weight;
}

/// One edge's share of the vector form factor; both ends on the unit sphere.
template <class T>
glm::vec<3, T> edge_share(const glm::vec<3, T>& a, const glm::vec<3, T>& b) {
    return glm::cross(a, b) * edge_weight(glm::dot(a, b));
}

/// Vector form factor of the polygon with these corners, any length each, by its edges.
template <class V, class... Rest>
V vector_form_factor(const V& first, const Rest&... rest) {
    const std::array<V, sizeof...(Rest) + 1> p = {glm::normalize(first), glm::normalize(rest)...};
    V sum = edge_share(p.back(), p.front());
    for (size_t i = 1; i < p.size(); ++i) sum += edge_share(p[i - 1], p[i]);
    return sum;
}

/// Corners of a quad that are above the horizon, by the bits "corner i is above": the first of the run, and how many.
/// Two opposite corners alone (5 and 10) cannot be, and count as nothing.
inline constexpr std::array<unsigned, 16> first_above = {0, 0, 1, 0, 2, 0, 1, 0, 3, 3, 0, 3, 2, 2, 1, 0};
inline constexpr std::array<unsigned, 16> count_above = {0, 1, 1, 2, 1, 0, 2, 3, 1, 2, 0, 3, 2, 3, 3, 4};

/// Form factor of a quad (four corners, counter-clockwise seen from the side that emits) under a cosine, as Heitz,
/// Dupuy, Hill and Neubelt 2016 and most renderers compute it: clipped at z = 0 by cases with crossings that are not
/// divided, corners scaled to length 1, Lambert's sum with the fit. 0 to 1 where it works; NaN for a corner at 0.
template <class T>
T clipped_polygon(std::span<const glm::vec<3, T>> corners_in_cosine_space, bool two_sided = false) {
    using V = glm::vec<3, T>;
    assert(corners_in_cosine_space.size() == 4);
    const V* corners = corners_in_cosine_space.data();
    const unsigned bits = (corners[0].z > 0 ? 1U : 0U) + (corners[1].z > 0 ? 2U : 0U) + (corners[2].z > 0 ? 4U : 0U) +
                          (corners[3].z > 0 ? 8U : 0U);
    const unsigned first = first_above[bits];
    const V &a = corners[first], &b = corners[(first + 1) % 4], &c = corners[(first + 2) % 4],
            &d = corners[(first + 3) % 4];
    const auto crossing = [](const V& above, const V& below) { return above.z * below - below.z * above; };
    T sum = 0;
    switch (count_above[bits]) {
        case 1:
            sum = vector_form_factor(a, crossing(a, b), crossing(a, d)).z;
            break;
        case 2:
            sum = vector_form_factor(a, b, crossing(b, c), crossing(a, d)).z;
            break;
        case 3:
            sum = vector_form_factor(a, b, c, crossing(c, d), crossing(a, d)).z;
            break;
        case 4:
            sum = vector_form_factor(a, b, c, d).z;
            break;
        default:
            break;
    }
    return two_sided ? std::abs(sum) : std::max(-sum, T(0));
}

/// What stands in for the light at the horizon: a sphere with the light's vector form factor.
enum class Proxy {
    sphere,   ///< its form factor in closed form
    table,    ///< 64 x 64 values of it, between which is interpolated (Hill and Heitz 2017; Kanikama, Blender)
    fraction  ///< (l^2 + z) / (l + 1), l: length of the vector form factor, z: its part along the normal (three.js)
};

/// Form factor of a sphere at the horizon or away from it: `length` in [0, 1] is the squared sine of its angular
/// radius, `cosine` in [-1, 1] that of the direction to it (Lagarde and de Rousiers 2014, after Snyder 1996).
template <class T>
T clipped_sphere(T length, T cosine) {
    if (cosine * cosine >= length) return std::max(cosine, T(0)) * length;
    const T sine = std::sqrt(1 - cosine * cosine), cotangent = std::sqrt(1 / length - 1);
    const T y = -cotangent * cosine / sine, root = sine * std::sqrt(std::max(1 - y * y, T(0)));
    return (length * (cosine * std::acos(std::clamp(y, T(-1), T(1))) - cotangent * root) +
            std::atan2(root, cotangent)) /
           T(pi);
}

/// `clipped_sphere` over `length`, from the table: even in (cosine + 1) / 2 and length.
float tabled_sphere_ratio(float length, float cosine);

/// Form factor at the horizon of a light with this vector form factor's length and direction.
template <class T>
T at_horizon(T length, T cosine, Proxy proxy) {
    switch (proxy) {
        case Proxy::sphere:
            return clipped_sphere(std::min(length, T(1)), std::clamp(cosine, T(-1), T(1)));
        case Proxy::table:
            return length * T(tabled_sphere_ratio(float(length), float(cosine)));
        case Proxy::fraction:
            return std::max((length * length + length * cosine) / (length + 1), T(0));
    }
    return 0;
}

/// The same form factor without clipping: Lambert's vector of the whole quad, then the proxy. NaN for a vector of 0.
template <class T>
T clipless_polygon(std::span<const glm::vec<3, T>> corners_in_cosine_space, Proxy proxy, bool two_sided = false) {
    using V = glm::vec<3, T>;
    assert(corners_in_cosine_space.size() == 4);
    const V* corners = corners_in_cosine_space.data();
    const bool is_behind = glm::dot(glm::cross(corners[1] - corners[0], corners[3] - corners[0]), corners[0]) > 0;
    if (is_behind && !two_sided) return 0;
    const V sum = vector_form_factor(corners[0], corners[1], corners[2], corners[3]);
    const T length = glm::length(sum), cosine = sum.z / length;
    return at_horizon(length, is_behind ? cosine : -cosine, proxy);
}

/// What a shader looks up: the inverse matrix between the table's own entries (x, y, z, w; middle entry 1),
/// interpolated linearly (Heitz et al. 2016), where ours interpolates numbers of a lobe. Their numbers are those of our
/// fit at the nodes. Roughness and `cosine` (N.V) in [0, 1].
struct TabledLobe {
    glm::mat3 inverse;  ///< from (tangent of the view's plane, bitangent, normal)
    float albedo, fresnel;
};
TabledLobe lobe_at(float roughness, float cosine);

/// Form factors of a quad light at one point, and the numbers that its specular share is weighted with.
struct Shares {
    float diffuse, specular;
    float albedo, fresnel;
};

/// What a shader does at a point for one quad light: frame, table, transform, both integrals. `normal` and `view` are
/// unit vectors; corners run counter-clockwise seen from the side that emits.
Shares clipped_quad(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness);
Shares clipless_quad(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness, Proxy proxy);

}  // namespace surimi::published
