// SPDX-License-Identifier: Apache-2.0
// What the tests of hazards share: random lights, exact answers in long double, and the worst error of many.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "runtime/ltc/ellipse.h"
#include "runtime/ltc/polygon.h"
#include "tests/support/quadrature.h"
#include "tests/support/random.h"

namespace surimi::hazard {

using test::Vec3l;
using Corners = std::vector<Vec3>;

/// The worst of some errors, which the test's report keeps.
struct Worst {
    double value = 0;
    void add(double error) { value = error <= value ? value : error; }  // a NaN stays
    void expect_below(double tolerance, const std::string& key) const {
        EXPECT_LE(value, tolerance) << key;
        char text[32];
        std::snprintf(text, sizeof text, "%.1e", value);
        testing::Test::RecordProperty(key, text);
    }
};

/// Emits downwards, as seen from below.
inline Corners ceiling(double x0, double x1, double y0, double y1, double h) {
    return {{x0, y0, h}, {x0, y1, h}, {x1, y1, h}, {x1, y0, h}};
}

inline double of(const Corners& corners, const Vec3& n, bool two_sided = true) {
    const double e = irradiance_of_polygon<double>(corners, Vec3(0), n, two_sided);
    EXPECT_TRUE(e >= 0 && e <= pi) << e;
    return e;
}

inline double exact(const Corners& corners, const Vec3& n) {
    const std::vector<Vec3l> wide(corners.begin(), corners.end());
    return static_cast<double>(test::corner_irradiance(wide, Vec3l(n)));
}

inline double of(const Ellipse<double>& ellipse, const Vec3& n) {
    const double e = irradiance_of_ellipse(ellipse, Vec3(0), n, true);
    EXPECT_TRUE(e >= 0 && e <= pi) << e;
    return e;
}

inline double exact(const Ellipse<double>& e, const Vec3& n) {
    return static_cast<double>(test::outline_irradiance({Vec3l(e.centre), Vec3l(e.half_u), Vec3l(e.half_v)}, Vec3l(n)));
}

template <class Light>
inline double absolute_error(const Light& light, const Vec3& n) {
    return std::abs(of(light, n) - exact(light, n)) / pi;
}

template <class Light>
inline double relative_error(const Light& light, const Vec3& n, double floor) {
    const double expected = exact(light, n);
    return expected > floor ? std::abs(of(light, n) / expected - 1) : 0;
}

inline Vec3 steep_normal(Choice& choice) {
    for (;;)
        if (const Vec3 n = choice.direction(); std::abs(n.z) > 0.05) return n;
}

}  // namespace surimi::hazard
