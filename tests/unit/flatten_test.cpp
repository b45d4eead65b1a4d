// SPDX-License-Identifier: Apache-2.0
// How patches are laid flat: distortion, forecast, relaxation.
#include <gtest/gtest.h>

#include <numeric>

#include "baker/unwrap/curvature.h"
#include "baker/unwrap/distortion.h"
#include "baker/unwrap/relax.h"
#include "baker/unwrap/starts.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

using test::Mesh;

Patch patch_of(const Mesh& mesh) {
    const Scene scene = test::scene_of({mesh});
    const FaceGraph graph = build_face_graph(scene.surfaces[0]);
    std::vector<uint32_t> number(graph.corners.size());
    return build_patch(graph, SeamFlags(graph), by_rank(graph), number);
}

/// A cap of the unit sphere around the z axis, of half angle `t`.
Mesh cap(double t, int rings, int spokes) {
    Mesh mesh;
    mesh.positions.emplace_back(0, 0, 1);
    for (int i = 1; i <= rings; ++i) {
        for (int j = 0; j < spokes; ++j) {
            const double x = t * i / rings;
            const double a = 2 * pi * j / spokes;
            mesh.positions.emplace_back(std::sin(x) * std::cos(a), std::sin(x) * std::sin(a), std::cos(x));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<uint32_t>(i == 0 ? 0 : 1 + (i - 1) * spokes + j % spokes); };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < spokes; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

TEST(Distortion, OfAStretchedSquare_M40_M41) {
    const Patch patch = patch_of({{Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, {{0, 1, 2}, {0, 2, 3}}});
    std::vector<Vec2> points;
    for (const Vec3& p : patch.positions) points.emplace_back(4 * p.x, p.y);
    for (size_t t = 0; t < 2; ++t) EXPECT_NEAR(glm::determinant(jacobian(patch, points, t)), 4, 1e-12);
    EXPECT_NEAR(symmetric_dirichlet(patch, points), 16 + 1 + 1.0 / 16 + 1, 1e-12);
    const Distortion d = measure_distortion(patch, points);
    EXPECT_NEAR(d.energy, 2 * (4 + 0.25), 1e-12);  // 2 and 1/2 at its own area
    EXPECT_NEAR(d.stretch, 2, 1e-12);
    EXPECT_FALSE(d.is_flipped);
    for (Vec2& p : points) p.y = -p.y;
    EXPECT_TRUE(measure_distortion(patch, points).is_flipped);
    EXPECT_TRUE(std::isinf(symmetric_dirichlet(patch, points)));
}

TEST(Forecast, ScalesOfASphericalCap_M44) {
    const double t = 1.0;
    const Mesh mesh = cap(t, 40, 96);
    const Patch patch = patch_of(mesh);
    const std::vector<double> u = conformal_logarithms(patch);
    double top = 0;
    for (const double value : u) top = std::min(top, value);
    // The mesh is inside the sphere by about the square of its edges, 0.4 %.
    EXPECT_NEAR(top, 2 * std::log(std::cos(t / 2)), 2e-3);
    const auto flat = flatten_within(patch, u, {5, 2});
    ASSERT_TRUE(flat);
    EXPECT_NEAR(predicted_energy(patch, u) - 4, flat->distortion.energy - 4, 0.3 * (flat->distortion.energy - 4));
}

TEST(Forecast, ClosedPatchesHaveNone_M44) {
    const Patch patch = patch_of(test::ico_sphere(2));
    EXPECT_TRUE(conformal_logarithms(patch).empty());
    EXPECT_TRUE(std::isinf(predicted_energy(patch, {})));
}

TEST(Starts, TheConformalOneIsExactWhereTheSurfaceIsDevelopable_M44) {
    const Patch patch = patch_of(test::arch(4, 200));
    Laplacian laplacian(patch);
    std::vector<Vec2> points;
    ASSERT_TRUE(make_start(patch, Start::conformal, conformal_logarithms(patch), laplacian, points));
    const Distortion d = measure_distortion(patch, points);
    EXPECT_NEAR(d.energy, 4, 1e-9);
    EXPECT_NEAR(d.stretch, 1, 1e-6);
}

TEST(Starts, TuttesHasNoFlipsWithHolesEither) {
    for (const Mesh& mesh : {test::dome(12, 48), test::terrain(24), test::cloth(40, 10)}) {
        const Patch patch = patch_of(mesh);
        Laplacian laplacian(patch);
        std::vector<Vec2> points;
        ASSERT_TRUE(make_start(patch, Start::tutte, {}, laplacian, points));
        EXPECT_TRUE(std::isfinite(symmetric_dirichlet(patch, points)));
    }
}

TEST(Relax, EndsWhereNoPointCanMove_M42) {
    const Patch patch = patch_of(cap(1.1, 10, 30));
    Laplacian laplacian(patch);
    std::vector<Vec2> points;
    ASSERT_TRUE(make_start(patch, Start::tutte, {}, laplacian, points));
    const double before = symmetric_dirichlet(patch, points);
    for (int i = 0; i < 8; ++i) relax(patch, INFINITY, laplacian, points);  // each ends when little is left to gain
    const double energy = symmetric_dirichlet(patch, points);
    EXPECT_LT(energy, before);
    Choice random{{3}};
    for (int i = 0; i < 200; ++i) {
        std::vector<Vec2> moved = points;
        moved[static_cast<size_t>(i) % moved.size()] += 0.01 * Vec2(random.between(-1, 1), random.between(-1, 1));
        EXPECT_GT(symmetric_dirichlet(patch, moved), energy - 1e-6);
    }
}

TEST(Relax, StaysFreeOfFlipsFromABadStart_M42) {
    const Patch patch = patch_of(test::cloth(60, 20));
    Laplacian laplacian(patch);
    std::vector<Vec2> points;
    ASSERT_TRUE(make_start(patch, Start::tutte, {}, laplacian, points));
    relax(patch, INFINITY, laplacian, points);
    EXPECT_FALSE(measure_distortion(patch, points).is_flipped);
}

TEST(Patches, LoopsAndGenus) {
    EXPECT_EQ(patch_of(test::ico_sphere(1)).euler_characteristic(), 2);
    EXPECT_EQ(patch_of(test::torus(12, 8)).euler_characteristic(), 0);
    const Patch dome = patch_of(test::dome(4, 12));
    EXPECT_EQ(dome.euler_characteristic(), 0);
    EXPECT_EQ(dome.loops.size(), 2u);
    const Patch arch = patch_of(test::arch(2, 10));
    EXPECT_EQ(arch.euler_characteristic(), 1);
    EXPECT_EQ(arch.loops.size(), 1u);
    EXPECT_NEAR(std::accumulate(arch.areas.begin(), arch.areas.end(), 0.0), 1, 1e-12);
}

}  // namespace
}  // namespace surimi
