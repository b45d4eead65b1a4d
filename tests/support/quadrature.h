// SPDX-License-Identifier: Apache-2.0
// Adaptive quadrature in long double, and the irradiance of curved shapes by it: over their areas, and along outlines.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/ltc/ellipse.h"

namespace surimi::test {

using Real = long double;
using Vec3l = glm::vec<3, Real>;
inline constexpr Real pi_l = 3.14159265358979323846264338327950288L;

/// Integral of f from a to b by Gauss and Kronrod's 7 and 15 points, halved until the two agree to `relative` of the
/// first estimate of the whole or the interval is one of rounding.
Real integral(const std::function<Real(Real)>& f, Real a, Real b, Real relative = 1e-15L);

/// Parts of [from, to] (at most 2 pi long) where c + x cos(t) + y sin(t) >= 0.
std::vector<std::pair<Real, Real>> parts_above(Real c, Real x, Real y, Real from, Real to);

/// What a light's area is integrated with: a function of the place p on it, per area as seen from the origin (times
/// |m.p|, m the unit normal), and the planes through the origin below which it is 0.
struct Receiver {
    std::function<Real(const Vec3l&)> value;
    std::vector<Vec3l> normals;
};

/// (n.p) / |p|^4: integrals are irradiances.
Receiver cosine_receiver(const Vec3l& n);
/// The density of a lobe above the true horizon, over |p|^3: integrals are shares of the lobe, not divided by what of
/// it is above. `to_cosine` and `normal` as in PlacedLobe.
Receiver lobe_receiver(const Mat3& to_cosine, const Vec3& normal);

/// Integral over the parallelogram corner + s u + t v, s and t in [0, 1], both sides.
Real area_integral(const Vec3l& corner, const Vec3l& u, const Vec3l& v, const Receiver& receiver);
/// Integral over both sides of an ellipse, over the part of an ellipsoid's surface that faces the origin, and over that
/// of a capped cylinder from a to b. They share nothing with the contour integrals.
Real area_integral(const Ellipse<Real>& ellipse, const Receiver& receiver);
Real area_integral(const Ellipsoid<Real>& ellipsoid, const Receiver& receiver);
Real area_integral(const Vec3l& a, const Vec3l& b, Real radius, const Receiver& receiver);
/// Integral along a line, per width.
Real line_integral(const Vec3l& from, const Vec3l& to, const Receiver& receiver);

/// Irradiance at the origin with unit normal n of both sides of an ellipse: the double integral of (n.p)(m.p) / |p|^4
/// over its area, cut at the horizon.
Real area_irradiance(const Ellipse<Real>& ellipse, const Vec3l& n);
/// The same of an ellipsoid, over the part of its surface that faces the origin.
Real area_irradiance(const Ellipsoid<Real>& ellipsoid, const Vec3l& n);
/// The same of a capped cylinder from a to b.
Real area_irradiance(const Vec3l& a, const Vec3l& b, Real radius, const Vec3l& n);

/// Irradiance at the origin of both sides of an ellipse by Stokes' theorem: quadrature of n.(p x dp) / |p|^2 along the
/// ellipse as given, not along its cone, closed along the horizon. For lights too thin or too near for the area.
Real outline_irradiance(const Ellipse<Real>& ellipse, const Vec3l& n);

/// Irradiance at the origin of both sides of a polygon: clipped to a list of corners, then Lambert's sum.
Real corner_irradiance(std::span<const Vec3l> corners, const Vec3l& n);

}  // namespace surimi::test
