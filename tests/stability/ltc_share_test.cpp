// SPDX-License-Identifier: Apache-2.0
// Shares of a lobe in the cases that break published code: light from below the surface, and light that cancels.
#include <gtest/gtest.h>

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
