// SPDX-License-Identifier: Apache-2.0
// Polygons that are not what irradiance_of_polygon is for: concave, crossing themselves, not planar (H30).
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/stability/hazard.h"

namespace surimi {
namespace {

using namespace hazard;

/// Signed: negative for the back.
double signed_irradiance(const Corners& corners, const Vec3& n) {
    const Corners turned(corners.rbegin(), corners.rend());
    return of(corners, n, false) - of(turned, n, false);
}

/// A notched quad (an arrowhead) in a random plane, counter-clockwise as its first three corners, and its two halves.
struct Arrowhead {
    Corners outline, left, right;
};

Arrowhead arrowhead(Choice& choice) {
    const Vec3 tip = choice.vector(), u = choice.direction(), v = choice.direction();
    const Vec3 notch = tip + choice.between(0.1, 0.9) * (u + v) / 2.0;
    return {{tip, tip + u, notch, tip + v}, {tip, tip + u, notch}, {tip, notch, tip + v}};
}

int crossings(const Corners& corners, const Vec3& n) {
    int count = 0;
    for (size_t i = 0; i < corners.size(); ++i)
        count += (glm::dot(corners[i], n) >= 0) != (glm::dot(corners[(i + 1) % corners.size()], n) >= 0);
    return count;
}

TEST(StrangePolygon, H30_ConcaveIsTheSumOfItsPieces_M4) {
    Choice choice{{30}};
    Worst worst;
    int above = 0, twice = 0;
    for (int i = 0; i < 2000; ++i) {
        const Arrowhead a = arrowhead(choice);
        const Vec3 n = choice.direction();
        const int count = crossings(a.outline, n);
        if (count > 2) continue;
        (count == 0 ? above : twice) += of(a.outline, n) > 0;
        worst.add(
            std::abs(signed_irradiance(a.outline, n) - signed_irradiance(a.left, n) - signed_irradiance(a.right, n)));
    }
    EXPECT_GT(above, 100);
    EXPECT_GT(twice, 100);
    worst.expect_below(1e-13, "arrowheads");
}

TEST(StrangePolygon, H30_BowTieIsTheDifferenceOfItsTriangles_M1) {
    Choice choice{{31}};
    Worst worst;
    for (int i = 0; i < 500; ++i) {
        const Vec3 middle(choice.between(-1, 1), choice.between(-1, 1), 2.5), u = choice.direction(),
                                                                              v = choice.direction();
        const double s = choice.between(0.1, 1), t = choice.between(0.1, 1);
        // Both diagonals go through the middle; one triangle faces the other way.
        const Corners tie = {middle + u, middle - s * u, middle + v, middle - t * v};
        const Vec3 n(0, 0, 1);
        const double expected = signed_irradiance({middle - s * u, middle + v, middle}, n) +
                                signed_irradiance({middle - t * v, middle + u, middle}, n);
        worst.add(std::abs(signed_irradiance(tie, n) - expected));
    }
    worst.expect_below(1e-13, "bow-ties");
    const Corners even = {{-1, -1, 2}, {1, 1, 2}, {1, -1, 2}, {-1, 1, 2}};
    EXPECT_LT(of(even, {0, 0, 1}), 1e-15);
}

TEST(StrangePolygon, H30_SkewQuadIsEitherPairOfTriangles_M1) {
    Choice choice{{32}};
    Worst worst;
    for (int i = 0; i < 500; ++i) {
        Corners quad = ceiling(-1, 1, -1, 1, 2.5);
        for (Vec3& corner : quad) corner += choice.vector();
        const Vec3 n(0, 0, 1);
        const double value = signed_irradiance(quad, n);
        for (const size_t k : {0U, 1U})
            worst.add(std::abs(value - signed_irradiance({quad[k], quad[k + 1], quad[k + 2]}, n) -
                               signed_irradiance({quad[k], quad[k + 2], quad[(k + 3) % 4]}, n)));
    }
    worst.expect_below(1e-13, "skew quads");
}

TEST(StrangePolygon, H30_AnythingIsFiniteAndAtMostPi_M4) {
    // `of` checks the range. Any corners, in any order, some on the horizon, some twice, some at the point.
    Choice choice{{33}};
    int crossing_often = 0;
    for (int i = 0; i < 20'000; ++i) {
        Corners corners(static_cast<size_t>(3 + i % 6));
        for (Vec3& corner : corners) corner = choice.vector();
        if (i % 5 == 0) corners[1].z = 0;
        if (i % 7 == 0) corners[2] = corners[0];
        if (i % 11 == 0) corners[0] = Vec3(0);
        if (i % 13 == 0) corners[1] = -corners[2];
        const Vec3 n = i % 3 ? choice.direction() : Vec3(0, 0, 1);
        crossing_often += crossings(corners, n) > 2;
        const double both = of(corners, n), front = of(corners, n, false);
        EXPECT_TRUE(front == 0 || front == both) << i;
    }
    EXPECT_GT(crossing_often, 1000);
}

}  // namespace
}  // namespace surimi
