// SPDX-License-Identifier: Apache-2.0
// The published way to shade with disk and ellipse lights (Heitz and Hill 2017, "Real-Time Line- and Disk-Light Shading
// with Linearly Transformed Cosines"), written anew from its formulae, to be measured against.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "runtime/ltc/ellipse.h"
#include "runtime/shade/published.h"

namespace surimi::test {

/// Ways to the eigenvalues of Q, the 2 x 2 matrix of products of the half axes.
enum class AxesBy {
    plain,  ///< tr / 2 -+ sqrt(tr^2 / 4 - det)
    root,   ///< squares of the eigenvalues of sqrt(Q), whose trace is sqrt(tr + 2 sqrt(det))
    sums    ///< (u -+ v)^2 with 2 u, 2 v = sqrt(tr -+ 2 sqrt(det))
};

/// Least and greatest eigenvalue of a matrix with this trace and determinant.
template <class T>
std::pair<T, T> published_eigenvalues(T trace, T determinant, AxesBy by) {
    const T root = std::sqrt(determinant);
    const auto square = [](T x) { return x * x; };
    if (by == AxesBy::plain) {
        const T half = trace / 2, spread = std::sqrt(half * half - determinant);
        return {half - spread, half + spread};
    }
    if (by == AxesBy::root) {
        const T sum = std::sqrt(trace + 2 * root), spread = std::sqrt(sum * sum - 4 * root);
        return {square((sum - spread) / 2), square((sum + spread) / 2)};
    }
    const T u = std::sqrt(trace - 2 * root) / 2, v = std::sqrt(trace + 2 * root) / 2;
    return {square(v - u), square(v + u)};
}

/// That of the outer roots of t^3 + 3 c t + d, minus `shift`, which is farther from 0; `root` is that of the
/// discriminant.
template <class T>
T published_outer_root(T c, T d, T root, T shift) {
    const T angle = std::atan2(root, -d) / 3, radius = 2 * std::sqrt(-c);
    const T first = radius * std::cos(angle), last = radius * std::cos(angle + T(2 * pi / 3));
    return (first + last > 2 * shift ? first : last) - shift;
}

/// The real roots of x^3 + 3 b x^2 + 3 c x + d, least first, by Blinn 2007: the largest and the smallest magnitude,
/// this as the largest one of the reversed cubic, and the third from the quotient. NaN where rounding makes the
/// discriminant negative, because it has no bound.
template <class T>
std::array<T, 3> published_cubic_roots(T b, T c, T d) {
    const T delta1 = c - b * b, delta2 = d - b * c, delta3 = b * d - c * c;
    const T root = std::sqrt(4 * delta1 * delta3 - delta2 * delta2);
    const T large = published_outer_root(delta1, delta2 - 2 * b * delta1, root, b);
    const T e = published_outer_root(delta3, d * delta2 - 2 * c * delta3, std::abs(d) * root, c);
    const T f = -large * e - d, g = large * d;  // (x - large) (e x - d) = e x^2 + f x + g
    std::array<T, 3> roots = {d / e, (c * f - b * g) / (c * e - b * f), large};
    if (roots[1] < roots[0]) std::swap(roots[0], roots[1]);
    if (roots[2] < roots[0]) std::swap(roots[0], roots[2]);
    return roots;
}

/// Unit principal axes of an ellipse and its squared half lengths.
template <class T>
struct PublishedAxes {
    glm::vec<3, T> u, v;
    T u2, v2;
};

template <class T>
PublishedAxes<T> published_axes(const glm::vec<3, T>& u, const glm::vec<3, T>& v, AxesBy by) {
    const T uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    if (!(std::abs(uv) / std::sqrt(uu * vv) > T(1e-4))) return {u / std::sqrt(uu), v / std::sqrt(vv), uu, vv};
    const auto [least, greatest] = published_eigenvalues(uu + vv, uu * vv - uv * uv, by);
    // Eigenvectors (uv, e - uu) of Q, from the longer half axis.
    const bool is_u_longer = uu > vv;
    const auto axis = [&](T e) { return glm::normalize(is_u_longer ? uv * u + (e - uu) * v : uv * v + (e - vv) * u); };
    return {axis(greatest), axis(least), greatest, least};
}

/// A light's vector form factor.
template <class T>
struct VectorFormFactor {
    T length;
    glm::vec<3, T> axis;  ///< unit, towards the light
};

/// Of an ellipse relative to the point: principal axes, the cone through the ellipse as a quadric, its axes by the
/// cubic. NaN for half axes of 0 and wherever a root fails.
template <class T>
VectorFormFactor<T> published_disk_vector(const Ellipse<T>& ellipse, AxesBy by) {
    using V = glm::vec<3, T>;
    const PublishedAxes<T> axes = published_axes(ellipse.half_u, ellipse.half_v, by);
    V across = glm::cross(axes.u, axes.v);
    if (glm::dot(across, ellipse.centre) < 0) across = -across;
    const T distance = glm::dot(across, ellipse.centre);
    const T x = glm::dot(axes.u, ellipse.centre) / distance, y = glm::dot(axes.v, ellipse.centre) / distance;
    // The cone a (X - x Z)^2 + b (Y - y Z)^2 = Z^2, and the characteristic polynomial of its matrix.
    const T a = distance * distance / axes.u2, b = distance * distance / axes.v2;
    const T trace = a * (1 + x * x) + b * (1 + y * y) - 1, minors = a * b * (1 + x * x + y * y) - a - b;
    const auto [e, e1, e2] = published_cubic_roots(-trace / 3, minors / 3, a * b);
    const T square1 = -e / e1, square2 = -e / e2;  // of the half widths of the cone at Z = 1
    return {std::sqrt(square1) * std::sqrt(square2) / std::sqrt((1 + square1) * (1 + square2)),
            glm::normalize(a * x / (a - e) * axes.u + b * y / (b - e) * axes.v + across)};
}

/// Form factor of an ellipse in the cosine's space: that vector, then the proxy at the horizon.
template <class T>
T published_disk(const Ellipse<T>& ellipse, AxesBy by, published::Proxy proxy, bool two_sided = false) {
    if (!two_sided && glm::dot(glm::cross(ellipse.half_u, ellipse.half_v), ellipse.centre) >= 0) return 0;
    const VectorFormFactor<T> vector = published_disk_vector(ellipse, by);
    return published::at_horizon(vector.length, vector.axis.z, proxy);
}

}  // namespace surimi::test
