// SPDX-License-Identifier: Apache-2.0
// Exact answers in double, by other ways than the code under test.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/light/monitor.h"

namespace surimi::test {

/// Form factor from a differential element to a parallel rectangle w x l at height h whose corner is right above the
/// element (Howell, configuration factor B-3).
double corner_form_factor(double w, double l, double h);

/// Irradiance by brute-force midpoint quadrature over a parallelogram light with n x n cells; shares nothing with
/// Lambert's formula.
double irradiance_by_quadrature(const Polygon& light, const Vec3& point, const Vec3& normal, int n);

/// A convex occluder: the convex hull of these points hides what is behind it.
struct Occluder {
    std::vector<Vec3> points;
};

/// Exact visibility of a convex planar light from a point past disjoint convex occluders that lie between the point and
/// the light's plane: one minus the share of irradiance of the light's part behind the projected hulls. Occluders must
/// not overlap as seen from the point.
double exact_visibility(const Polygon& light, const Vec3& point, const Vec3& normal,
                        std::span<const Occluder> occluders);

}  // namespace surimi::test
