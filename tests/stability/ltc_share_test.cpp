// SPDX-License-Identifier: Apache-2.0
// Shares of a lobe in the cases that break published code: light from below the surface, and light that cancels.
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/ltc/placed_lobe.h"
#include "tests/stability/hazard.h"

namespace surimi {
namespace {

using namespace hazard;

struct Lights {
    Corners corners;
    Ellipse<double> ellipse;
    Ellipsoid<double> ellipsoid;
    Cylinder<double> cylinder;
};

/// Lights as they come, moved along the normal until they just touch its horizon from below.
Lights below(Choice& choice, const Vec3& normal, double gap) {
    const Vec3 c = 2.0 * choice.vector(), u = choice.vector(), v = choice.vector(), w = choice.vector();
    const auto lowered = [&](const Vec3& centre, double reach) {
        return centre - normal * (glm::dot(normal, centre) + reach * (1 + 1e-12) + gap);
    };
    const double nu = glm::dot(normal, u), nv = glm::dot(normal, v), nw = glm::dot(normal, w);
    const Vec3 quad = lowered(c, std::abs(nu) + std::abs(nv)), disk = lowered(c, std::hypot(nu, nv));
    const double radius = choice.between(0.01, 1);
    const Vec3 axis = glm::normalize(w);
    const double cap = radius * glm::length(glm::cross(normal, axis));
    const Vec3 lamp = lowered(c, std::abs(nw) + cap);
    return {{quad - u - v, quad + u - v, quad + u + v, quad - u + v},
            {disk, u, v},
            {lowered(c, std::hypot(nu, nv, nw)), {u, v, w}},
            {lamp - w, lamp + w, radius}};
}

TEST(ShareHazard, H28_LightFromBelowTheSurfaceIsExactlyNone_M17) {
    Choice choice{{28}};
    int leaking = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 normal = choice.direction();
        const PlacedLobe lobe = place_lobe(normal, choice.direction(), choice.between(0, 1));
        const Lights lights = below(choice, normal, i % 2 ? 0 : 0.01);
        EXPECT_EQ(specular_share_of_polygon(lobe, lights.corners, Vec3(0), true), 0);
        EXPECT_EQ(specular_share_of_ellipse(lobe, lights.ellipse, Vec3(0), true), 0);
        EXPECT_EQ(specular_share_of_ellipsoid(lobe, lights.ellipsoid, Vec3(0)), 0);
        EXPECT_EQ(specular_share_of_cylinder(lobe, lights.cylinder, Vec3(0)), 0);
        EXPECT_EQ(specular_share_of_line(lobe, lights.corners[0], lights.corners[1], Vec3(0)), 0);
        // Without the cut the lobe would see some of them.
        Corners transformed;
        for (const Vec3& corner : lights.corners) transformed.push_back(lobe.to_cosine * corner);
        leaking += of(transformed, {0, 0, 1}) > 1e-4;
    }
    EXPECT_GT(leaking, 100);
}

TEST(ShareHazard, H28_RisingLightsAppearWithoutAJump_M17) {
    Choice choice{{29}};
    Worst jump;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 normal = choice.direction();
        const PlacedLobe lobe = place_lobe(normal, choice.direction(), choice.between(0.3, 1));
        const Lights lights = below(choice, normal, -1e-9);
        // Where a light towards the horizon passes the point, all of it may appear at once (H6, H7).
        const Vec3 &c = lights.ellipse.centre, &u = lights.ellipse.half_u, &v = lights.ellipse.half_v;
        if (glm::length(c) < 1.8 || std::abs(glm::dot(glm::cross(u, v), c)) < 0.05) continue;
        jump.add(specular_share_of_ellipse(lobe, lights.ellipse, Vec3(0), true));
        jump.add(specular_share_of_polygon(lobe, lights.corners, Vec3(0), true));
    }
    jump.expect_below(1e-5, "jump");
}

TEST(ShareHazard, H30_CombsAcrossTheHorizonAreTheirParts_M17) {
    // Polygons that leave and enter the horizon up to six times.
    Choice choice{{30}};
    Worst plain, in_lobe;
    int cut = 0;
    for (int i = 0; i < 2000; ++i) {
        const Mat3 turn = frame_of_view(choice.direction(), choice.direction());
        const Vec3 shift = 2.0 * choice.direction();
        const auto place = [&](double x, double y) { return turn * Vec3(x, y, 0.0) + shift; };
        const auto bar = [&](double x0, double x1, double y0, double y1) {
            return Corners{place(x0, y0), place(x1, y0), place(x1, y1), place(x0, y1)};
        };
        const Corners comb = {place(-2.5, -1), place(-1.5, -1), place(-1.5, 1), place(-0.5, 1),
                              place(-0.5, -1), place(0.5, -1),  place(0.5, 1),  place(1.5, 1),
                              place(1.5, -1),  place(2.5, -1),  place(2.5, 2),  place(-2.5, 2)};
        const Vec3 n = choice.direction();
        const PlacedLobe lobe = place_lobe(n, choice.direction(), choice.between(0.2, 1));
        double sum = 0, share = 0;
        for (const Corners& part :
             {bar(-2.5, -1.5, -1, 1), bar(-0.5, 0.5, -1, 1), bar(1.5, 2.5, -1, 1), bar(-2.5, 2.5, 1, 2)}) {
            sum += of(part, n);
            share += specular_share_of_polygon(lobe, part, Vec3(0), true);
        }
        plain.add(std::abs(of(comb, n) - sum) / pi);
        in_lobe.add(std::abs(specular_share_of_polygon(lobe, comb, Vec3(0), true) - share));
        Corners from_elsewhere = comb;  // the contour may begin anywhere, below the horizon too
        std::rotate(from_elsewhere.begin(), from_elsewhere.begin() + i % 12, from_elsewhere.end());
        plain.add(std::abs(of(from_elsewhere, n) - sum) / pi);
        const auto height = [&](size_t corner) { return glm::dot(comb[corner], n); };
        cut += height(0) < 0 && height(2) > 0 && height(4) < 0 && height(6) > 0 && height(8) < 0;
    }
    EXPECT_GT(cut, 30);
    plain.expect_below(1e-12, "irradiance");
    in_lobe.expect_below(1e-10, "share");
}

TEST(ShareHazard, H18_LightsThatCancelAreFinite_M17) {
    // The vector irradiance of lights all around a point is 0, and so is that of two faces back to back.
    Choice choice{{18}};
    for (int i = 0; i < 200; ++i) {
        const Vec3 u = choice.vector(), v = choice.vector(), n = choice.direction();
        const PlacedLobe lobe = place_lobe(n, choice.direction(), choice.between(0, 1));
        const Corners there = {u + v, u - v, -u - v, v - u};  // around the point, in its plane
        for (const double e : {of(there, n), specular_share_of_polygon(lobe, there, Vec3(0), true) * pi})
            EXPECT_TRUE(e >= 0 && e <= pi) << e;
        const Vec3 w = glm::cross(u, v);
        const Corners front = {w + u + v, w + u - v, w - u - v, w - u + v};
        Corners folded = front;  // there and back again over the same corners
        folded.insert(folded.end(), front.rbegin() + 1, front.rend() - 1);
        EXPECT_LT(of(folded, n), 1e-12);
        EXPECT_LT(specular_share_of_polygon(lobe, folded, Vec3(0), true), 1e-9);
        Corners opposite;
        for (const Vec3& corner : front) opposite.push_back(-corner);
        const double sum = of(front, n) + of(opposite, n);
        EXPECT_TRUE(sum >= 0 && sum <= pi) << sum;
    }
    const Ellipsoid<double> around{Vec3(0), {Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 1)}};
    EXPECT_EQ(irradiance_of_ellipsoid(around, Vec3(0), {0, 0, 1}), pi);
    EXPECT_EQ(specular_share_of_ellipsoid(place_lobe({0, 0, 1}, {0, 0, 1}, 0.5), around, Vec3(0)), 1);
    const Cylinder<double> tube{{0, 0, -1}, {0, 0, 1}, 0.5};
    EXPECT_EQ(specular_share_of_cylinder(place_lobe({0, 0, 1}, {0, 0, 1}, 0.5), tube, Vec3(0)), 1);
}

}  // namespace
}  // namespace surimi
