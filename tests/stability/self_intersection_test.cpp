// SPDX-License-Identifier: Apache-2.0
// Rays leave their surface without meeting it again, at any distance from the origin and at any grazing angle.
#include <gtest/gtest.h>

#include "runtime/trace/ray_scene.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A square of side `size` around `center`, tilted at random, whose surface faces its normal; plus a far small quad, so
/// that the scene's centre is not the square's.
Scene tilted_square(Random& random, const Vec3& center, double size) {
    const auto some = [&] { return 2 * random.next() - 1; };
    const Vec3 n = normalize_or({some(), some(), some()}, {0, 0, 1});
    const Vec3 u = normalize_or(glm::cross(n, Vec3(some(), some(), some())), {1, 0, 0}) * (0.5 * size);
    const Vec3 v = glm::cross(n, u);
    Scene scene;
    test::add_quad(scene, "Square", center - u - v, center + u - v, center + u + v, center - u + v);
    const uint32_t far =
        test::add_quad(scene, "Elsewhere", -center, -center + 0.1 * u, -center + 0.1 * v, -center - 0.1 * u);
    scene.surfaces[far].monitor = 2;  // rays towards monitor 2 pass it
    return scene;
}

TEST(RayOrigin, GrazingRaysNeverMeetTheirOwnSurface_M5) {
    Random random{8};
    size_t hits = 0, rays_shot = 0;
    for (const double distance : {0.0, 1.0, 100.0, 1e4, 1e6}) {
        for (const double size : {0.01, 1.0, 100.0}) {
            for (int square = 0; square < 20; ++square) {
                const Scene scene = tilted_square(random, distance * Vec3(1, -0.7, 0.4), size);
                const RayScene rays(scene);
                for (int i = 0; i < 200; ++i) {
                    const double a = std::sqrt(random.next()), b = random.next();
                    const SurfacePoint p = surface_point(scene, {0, i % 2 == 0 ? 0u : 1u}, {1 - a, a * (1 - b), a * b});
                    const Vec3 n = p.geometric_normal;
                    const Vec3 t =
                        normalize_or(glm::cross(n, Vec3(random.next(), random.next(), random.next() - 0.5)), {1, 0, 0});
                    const double cosine = std::pow(10, -3.5 * random.next());
                    const Vec3 direction = cosine * n + std::sqrt(1 - cosine * cosine) * t;
                    const Vec3 origin = rays.ray_origin(p);
                    ++rays_shot;
                    hits += rays.is_occluded(origin, origin + 10 * size * direction, 2);
                }
            }
        }
    }
    EXPECT_GT(rays_shot, 50000u);
    EXPECT_EQ(hits, 0u);
}

TEST(RayOrigin, LiesOnTheFrontAndNoFartherThanItsPrecision_M5) {
    Random random{9};
    for (const double distance : {0.0, 1.0, 100.0, 1e4, 1e6}) {
        const Scene scene = tilted_square(random, distance * Vec3(1, -0.7, 0.4), 1);
        const RayScene rays(scene);
        const SurfacePoint p = surface_point(scene, {0, 0}, Vec3(1.0 / 3));
        const double lift = glm::dot(rays.ray_origin(p) - p.position, p.geometric_normal);
        EXPECT_GT(lift, 0);  // the sign: off the front, whatever the sign of the normal's components
        EXPECT_LT(lift, 32 * 0x1p-24 * (distance + 1.5));
    }
}

TEST(RayOrigin, RaysThroughSharedVerticesAndEdgesDoNotLeak) {
    // A closed box seen from inside: rays at its corners, at its edges and at the diagonals of its faces.
    Scene scene;
    test::add_box(scene, "Box", {37, -12, 82}, {2, 3, 4}, true);
    const RayScene rays(scene);
    size_t leaks = 0;
    Random random{10};
    for (int i = 0; i < 20000; ++i) {
        const Vec3 origin = Vec3(37, -12, 82) + Vec3(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5);
        Vec3 target(random.next() < 0.5 ? -1 : 1, random.next() < 0.5 ? -1.5 : 1.5, random.next() < 0.5 ? -2 : 2);
        if (i % 2 == 0) target[i % 3] *= 2 * random.next() - 1;
        leaks += !rays.closest_hit(origin, Vec3(37, -12, 82) + target - origin);
    }
    EXPECT_LE(leaks, 20000u / 20);  // Embree's ROBUST still misses 1.8 % of exact vertices; see bakers.md 5b
}

}  // namespace
}  // namespace surimi
