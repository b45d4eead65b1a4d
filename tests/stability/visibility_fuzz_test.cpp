// SPDX-License-Identifier: Apache-2.0
// Random boxes, sheets and soups around random monitors: splitting against triangle subtraction.
#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

using test::Deviations;
using test::Mesh;
using test::VisibilityJudge;

constexpr int scenes = test::cases(400);

enum class Kind { boxes, sheets, soup, everything };

Mesh turned_box(Choice& choice) {
    const Vec3 x = choice.direction(), y = normalize_or(glm::cross(x, choice.vector()), {1, 0, 0}),
               z = glm::cross(x, y);
    const Vec3 center = 1.8 * choice.vector();
    Mesh mesh = test::box(Vec3(0), {choice.between(0.05, 1), choice.between(0.05, 1), choice.between(0.05, 1)});
    for (Vec3& p : mesh.positions) p = center + p.x * x + p.y * y + p.z * z;
    return mesh;
}

Mesh sheet(Choice& choice) {
    const Vec3 corner = 1.8 * choice.vector(), u = choice.vector(), v = choice.vector();
    return {{corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Loose triangles, some of which share vertices.
Mesh soup(Choice& choice) {
    Mesh mesh;
    for (int i = 0; i < 24; ++i) mesh.positions.push_back(2.0 * choice.vector());
    for (uint32_t t = 0; t < 12; ++t) {
        const auto vertex = [&] { return static_cast<uint32_t>(24 * choice.random.next()); };
        const std::array<uint32_t, 3> corners{vertex(), vertex(), vertex()};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
            mesh.triangles.push_back(corners);
    }
    if (mesh.triangles.empty()) mesh.triangles.push_back({0, 1, 2});
    return mesh;
}

Scene random_scene(Choice& choice, Kind kind) {
    Scene scene;
    test::add_box(scene, "Room", Vec3(0), Vec3(4), true);
    const Vec3 u = choice.direction(), v = normalize_or(glm::cross(u, choice.vector()), {0, 1, 0});
    test::add_monitor(scene, "Monitor_R", 0, choice.vector(), choice.between(0.2, 1) * u, choice.between(0.1, 0.8) * v);
    scene.monitors[0].two_sided = choice.random.next() < 0.3;
    if (choice.random.next() < 0.3) {
        const Vec3 corner = choice.vector();
        scene.monitors[0].panels.push_back({{corner, corner + 0.5 * choice.vector(), corner + 0.5 * choice.vector()}});
    }
    for (int i = 0; i < 6; ++i) {
        const Kind some = kind == Kind::everything ? static_cast<Kind>(i % 3) : kind;
        if (some == Kind::soup && kind == Kind::soup && i >= 2) break;
        test::add_surface(scene, "Occluder",
                          some == Kind::boxes    ? turned_box(choice)
                          : some == Kind::sheets ? sheet(choice)
                                                 : soup(choice));
    }
    return scene;
}

void expect_exact(Kind kind, uint64_t seed) {
    Choice choice{Random{seed}};
    Deviations found;
    for (int s = 0; s < scenes; ++s) {
        const VisibilityJudge judge(random_scene(choice, kind));
        for (int i = 0; i < 8; ++i) {
            const SurfacePoint point = test::random_point(judge.scene(), choice, i % 2);
            const test::SubtractedIrradiance truth = judge.truth(point);
            if (truth.unshadowed < 1e-6) continue;
            const double value = judge.split(point);
            found.add(value, truth.visibility(), point);
            EXPECT_NEAR(value, truth.visibility(), 1e-6 + test::float_ratio) << "scene " << s << " point " << i;
        }
    }
    EXPECT_GT(found.penumbra, scenes);
    EXPECT_LT(found.rmse(), 1e-7);
}

TEST(VisibilityFuzz, RandomBoxes_M53) {
    expect_exact(Kind::boxes, 51);
}

TEST(VisibilityFuzz, RandomSheets_M53) {
    expect_exact(Kind::sheets, 52);
}

TEST(VisibilityFuzz, RandomSoups_M53) {
    expect_exact(Kind::soup, 53);
}

TEST(VisibilityFuzz, EverythingAtOnce_M53) {
    expect_exact(Kind::everything, 54);
}

TEST(VisibilityFuzz, ScanlinesKeepTheirError_M55) {
    Choice choice{Random{55}};
    Deviations found;
    for (int s = 0; s < scenes; ++s) {
        const VisibilityJudge judge(random_scene(choice, Kind::everything));
        for (int i = 0; i < 16; ++i) {
            const SurfacePoint point = test::random_point(judge.scene(), choice, i % 2);
            const test::SubtractedIrradiance truth = judge.truth(point);
            if (truth.unshadowed > 1e-6) found.add(judge.scanline(point, 0.004), truth.visibility(), point);
        }
    }
    EXPECT_GT(found.penumbra, scenes);
    EXPECT_LE(found.rmse(), 0.001);
    EXPECT_LE(found.quantile(0.999), 0.004);
    EXPECT_LE(found.largest(), 0.02);
}

}  // namespace
}  // namespace surimi
