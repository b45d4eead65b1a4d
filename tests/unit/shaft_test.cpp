// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "baker/gather/silhouettes.h"
#include "tests/support/edge_sight.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr double scale = 10;

class Dice {
  public:
    explicit Dice(uint32_t seed) : random_(seed) {}
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    Vec3 place(double reach) {
        const double x = between(-reach, reach), y = between(-reach, reach), z = between(-reach, reach);
        return {x, y, z};
    }
    Vec3 direction() { return normalize_or(place(1), Vec3(0, 0, 1)); }

    /// Corners: 1, 2, 4 or 8, of a point, a segment, a parallelogram, a parallelepiped.
    std::vector<Vec3> block(int dimensions, double size) {
        std::vector<Vec3> corners = {place(4)};
        for (int d = 0; d < dimensions; ++d) {
            const Vec3 way = size * direction();
            for (size_t i = 0, n = corners.size(); i < n; ++i) corners.push_back(corners[i] + way);
        }
        return corners;
    }
    std::vector<Vec3> panel(double size) {
        const Vec3 c = place(4), u = direction();
        const Vec3 v = normalize_or(glm::cross(u, direction()), Vec3(1, 0, 0));
        const double width = between(0.2, 1) * size, height = between(0.2, 1) * size;
        return {c - width * u - height * v, c + width * u - height * v, c + width * u + height * v,
                c - width * u + height * v};
    }
    /// A point of the convex hull.
    Vec3 mixture(const std::vector<Vec3>& corners) {
        Vec3 sum(0);
        double weights = 0;
        for (const Vec3& corner : corners) {
            const double weight = -std::log(between(1e-9, 1));
            sum += weight * corner;
            weights += weight;
        }
        return sum / weights;
    }

  private:
    std::mt19937 random_;
};

double depth_in(const Shaft& shaft, const Vec3& place) {
    double depth = 1e30;
    for (const Shaft::Plane& plane : shaft.planes)
        depth = std::min(depth, glm::dot(plane.normal, place) + plane.offset);
    return depth;
}

TEST(Shaft, HoldsTheHullOfAnyBlockAndAnyPanel) {
    Dice dice(1);
    for (int i = 0; i < 400; ++i) {
        std::vector<Vec3> block = dice.block(i % 4, dice.between(0.01, 3));
        if (i % 5 == 0) block.push_back(block[0]);  // a corner twice
        block.resize(std::min<size_t>(block.size(), 8));
        const std::vector<Vec3> panel = dice.panel(2);
        const Shaft shaft = make_shaft(block, panel, scale);
        std::vector<Vec3> corners = block;
        corners.insert(corners.end(), panel.begin(), panel.end());
        ASSERT_GE(shaft.planes.size(), 4u);
        for (int k = 0; k < 50; ++k) {
            const double share = dice.between(0, 1);
            const Vec3 inside = glm::mix(dice.mixture(block), dice.mixture(panel), share);
            ASSERT_GE(depth_in(shaft, inside), 0.9 * shaft.margin);
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_GE(inside[axis], shaft.low[axis]);
                ASSERT_LE(inside[axis], shaft.high[axis]);
            }
        }
        for (const Shaft::Plane& plane : shaft.planes) {  // and touches it with every plane, at three corners or more
            int touching = 0;
            for (const Vec3& corner : corners)
                touching += std::abs(glm::dot(plane.normal, corner) + plane.offset - shaft.margin) < 1e-7 ? 1 : 0;
            ASSERT_GE(touching, 3);
        }
    }
}

TEST(Shaft, BetweenParallelRectanglesIsAFrustum) {
    const std::vector<Vec3> block = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
    const std::vector<Vec3> panel = {{-3, -2, 4}, {3, -2, 4}, {3, 2, 4}, {-3, 2, 4}};
    const Shaft shaft = make_shaft(block, panel, scale);
    EXPECT_EQ(shaft.planes.size(), 6u);
    EXPECT_LT(depth_in(shaft, {2.1, 0, 2}), 0);
    EXPECT_GT(depth_in(shaft, {1.9, 0, 2}), 0);
    EXPECT_LT(depth_in(shaft, {0, 0, -0.01}), 0);
    EXPECT_LT(depth_in(shaft, {0, 0, 4.01}), 0);
}

TEST(Shaft, OfAPointIsThePyramidUpToRounding) {
    const std::vector<Vec3> panel = {{-3, -2, 4}, {3, -2, 4}, {3, 2, 4}, {-3, 2, 4}};
    const std::vector<Vec3> point(4, Vec3(1, 1, 0));  // all corners of the block coincide
    const Shaft shaft = make_shaft(point, panel, scale);
    EXPECT_EQ(shaft.planes.size(), 5u);
    EXPECT_EQ(shaft.block_radius, 0);
    Dice dice(2);
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 place = dice.place(4);
        const double w = place.z / 4;
        const double s = place.x - 1 + w, t = place.y - 1 + w;  // of the panel's plane, times w
        const double outside = std::max({std::abs(s) - 3 * w, std::abs(t) - 2 * w, w - 1});
        if (std::abs(outside) < 1e-5) continue;
        EXPECT_EQ(depth_in(shaft, place) >= 0, outside < 0);
        inside += outside < 0 ? 1 : 0;
    }
    EXPECT_GT(inside, 20);
}

TEST(Shaft, OfABlockInThePanelsPlaneIsClosedByItsBounds) {
    const std::vector<Vec3> panel = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const std::vector<Vec3> block = {{3, 0, 1}, {4, 0, 1}, {3, 1, 1}, {4, 1, 1}};
    const Shaft shaft = make_shaft(block, panel, scale);
    EXPECT_EQ(shaft.planes.size(), 2u);
    EXPECT_GE(depth_in(shaft, {2, 0.5, 1}), 0);
    EXPECT_LT(depth_in(shaft, {2, 0.5, 1.1}), 0);
    EXPECT_GT(2 - shaft.margin, shaft.low.x);
    EXPECT_LT(shaft.high.x, 4.001);
}

struct Counts {
    size_t missed = 0, silhouettes = 0, found = 0, meeting = 0;
};

/// Every edge that is a silhouette on the panel from one of `points` of the block must be among the candidates.
void judge(const Silhouettes& silhouettes, const std::vector<Vec3>& block, const std::vector<Vec3>& panel,
           const std::vector<Vec3>& points, Counts& counts) {
    const Shaft shaft = make_shaft(block, panel, scale);
    std::vector<uint32_t> found = {77};
    find_candidates(silhouettes, shaft, 0, found);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    counts.found += found.size();
    for (uint32_t e = 0; e < silhouettes.edges.size(); ++e) {
        const Edge& edge = silhouettes.edges[e];
        bool is_needed = false;
        for (const Vec3& p : points)
            is_needed = is_needed || (test::jump_at(silhouettes, edge, p) != 0 &&
                                      test::is_before(p, panel, Vec3(edge.a), Vec3(edge.b), -1e-9));
        if (!is_needed) continue;
        ++counts.silhouettes;
        counts.missed += std::binary_search(found.begin(), found.end(), e) ? 0 : 1;
    }
}

std::vector<Scene> hard_scenes() {
    std::vector<Scene> scenes;
    for (const auto& mesh : {test::ico_sphere(4), test::torus(40, 20), test::foliage(600), test::mixed_winding(),
                             test::walls(), test::degenerate_grid(), test::touching_cubes()}) {
        double reach = 0;
        for (const Vec3& p : mesh.positions) reach = std::max(reach, glm::length(p));
        scenes.push_back(test::scene_of({test::scaled(mesh, 3 / reach)}));
    }
    Dice dice(3);
    Scene boxes;
    for (int i = 0; i < 60; ++i) {
        const Vec3 size = glm::abs(dice.place(1)) + 0.05;
        test::add_box(boxes, "box", dice.place(4), size, i % 7 == 0);
    }
    scenes.push_back(boxes);
    return scenes;
}

TEST(Candidates, HoldEverySilhouetteOfEveryPointOfTheBlock) {
    Dice dice(4);
    for (const Scene& scene : hard_scenes()) {
        const RayScene rays(scene);
        const Silhouettes silhouettes = find_silhouettes(scene, rays);
        Counts counts;
        for (int i = 0; i < 60; ++i) {
            const std::vector<Vec3> block = dice.block(i % 4, dice.between(0.01, 1));
            const std::vector<Vec3> panel = dice.panel(2);
            std::vector<Vec3> points = block;
            for (int k = 0; k < 12; ++k) points.push_back(dice.mixture(block));
            judge(silhouettes, block, panel, points, counts);
        }
        EXPECT_EQ(counts.missed, 0u);
        EXPECT_GT(counts.silhouettes, 50u);
        EXPECT_LT(counts.found, 3 * counts.silhouettes);  // the points are few, so even an exact answer holds more
    }
}

TEST(Candidates, OfAPointAreItsSilhouettesAndNoMore) {
    Dice dice(5);
    for (const Scene& scene : hard_scenes()) {
        const RayScene rays(scene);
        const Silhouettes silhouettes = find_silhouettes(scene, rays);
        std::vector<uint32_t> found;
        size_t total = 0;
        for (int i = 0; i < 40; ++i) {
            const std::vector<Vec3> point = dice.block(0, 1), panel = dice.panel(2);
            find_candidates(silhouettes, make_shaft(point, panel, scale), 0, found);
            for (const uint32_t e : found) {
                const Edge& edge = silhouettes.edges[e];
                EXPECT_TRUE(test::is_before(point[0], panel, Vec3(edge.a), Vec3(edge.b), 1e-5));
            }
            total += found.size();
        }
        EXPECT_GT(total, 50u);
    }
}

TEST(Candidates, LeaveOutTheMonitorsOwnEdges) {
    Scene scene;
    test::add_monitor(scene, "Monitor", 0, {0, 0, 2}, {0.5, 0, 0}, {0, 0.5, 0});
    test::add_monitor(scene, "Other", 1, {0, 0, 1}, {0.1, 0, 0}, {0, 0.1, 0});
    test::add_quad(scene, "floor", {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
    const RayScene rays(scene);
    const Silhouettes silhouettes = find_silhouettes(scene, rays);
    const std::vector<Vec3> point = {Vec3(0.05, 0.02, 0.01) - silhouettes.center};
    std::vector<Vec3> panel = scene.monitors[0].panels[0].corners;
    for (Vec3& corner : panel) corner -= silhouettes.center;
    const Shaft shaft = make_shaft(point, panel, scale);
    std::vector<uint32_t> found;
    find_candidates(silhouettes, shaft, 0, found);
    EXPECT_EQ(found.size(), 4u);
    for (const uint32_t e : found) EXPECT_EQ(silhouettes.edges[e].owner(), 1u);
    find_candidates(silhouettes, shaft, 1, found);
    for (const uint32_t e : found) EXPECT_EQ(silhouettes.edges[e].owner(), 0u);
}

/// A wall at z = 1 with or without a hole, between the floor and a panel at z = 2.
struct WallScene {
    Scene scene;
    uint32_t wall = 0;

    explicit WallScene(bool has_hole) {
        test::add_quad(scene, "floor", {-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0});
        const double edge = has_hole ? 0.02 : 0;
        wall = test::add_quad(scene, "wall", {-3, -3, 1}, {-edge, -3, 1}, {-edge, 3, 1}, {-3, 3, 1});
        Surface& surface = scene.surfaces[wall];
        const auto count = static_cast<uint32_t>(surface.positions.size());
        for (const Vec3& p : {Vec3(edge, -3, 1), Vec3(3, -3, 1), Vec3(3, 3, 1), Vec3(edge, 3, 1)}) {
            surface.positions.push_back(p);
            surface.normals.emplace_back(0, 0, 1);
        }
        surface.triangles.push_back({count, count + 1, count + 2});
        surface.triangles.push_back({count, count + 2, count + 3});
    }
};

TEST(Rim, OfAWallWithoutAHoleIsNotMetAndTheWallHidesAll_M51) {
    const WallScene room(false);
    const RayScene rays(room.scene);
    const Silhouettes silhouettes = find_silhouettes(room.scene, rays);
    Dice dice(6);
    const Vec3 to_center = silhouettes.center;
    std::vector<Vec3> block = {{-1, -1, 0.01}, {1, -1, 0.01}, {-1, 1, 0.01}, {1, 1, 0.01}};
    std::vector<Vec3> panel = {{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2}};
    for (std::vector<Vec3>* corners : {&block, &panel})
        for (Vec3& corner : *corners) corner -= to_center;
    const Shaft shaft = make_shaft(block, panel, scale);
    const uint32_t plane = silhouettes.plane_of[room.wall][0];
    EXPECT_EQ(plane, silhouettes.plane_of[room.wall][3]);
    EXPECT_FALSE(meets_rim(silhouettes, shaft, plane));
    EXPECT_TRUE(
        meets_rim(silhouettes, make_shaft(block, std::vector<Vec3>{{-9, -2, 2}, {2, -2, 2}, {2, 2, 2}}, scale), plane));
    for (int i = 0; i < 1000; ++i)
        EXPECT_TRUE(rays.is_occluded(dice.mixture(block) + to_center, dice.mixture(panel) + to_center, 0));
}

TEST(Rim, OfAHoleIsMet) {
    const WallScene room(true);
    const RayScene rays(room.scene);
    const Silhouettes silhouettes = find_silhouettes(room.scene, rays);
    std::vector<Vec3> block = {{-0.1, -1, 0.01}, {0.1, -1, 0.01}};
    std::vector<Vec3> panel = {{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2}};
    for (std::vector<Vec3>* corners : {&block, &panel})
        for (Vec3& corner : *corners) corner -= silhouettes.center;
    const uint32_t plane = silhouettes.plane_of[room.wall][0];
    EXPECT_TRUE(meets_rim(silhouettes, make_shaft(block, panel, scale), plane));
}

TEST(Cutouts, AreMetWhereTheyStandBetween) {
    Scene scene;
    test::add_quad(scene, "floor", {-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0});
    const uint32_t leaf = test::add_quad(scene, "leaf", {0, 0, 1}, {0.1, 0, 1}, {0.1, 0.1, 1.1}, {0, 0.1, 1.1});
    scene.materials.emplace_back().alpha_mode = AlphaMode::mask;
    scene.surfaces[leaf].material = 0;
    const RayScene rays(scene);
    const Silhouettes silhouettes = find_silhouettes(scene, rays);
    const auto shaft_from = [&](double x) {
        const std::vector<Vec3> block = {Vec3(x, 0, 0) - silhouettes.center,
                                         Vec3(x + 0.1, 0.1, 0) - silhouettes.center};
        std::vector<Vec3> panel = {{-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0.5, 0.5, 2}, {-0.5, 0.5, 2}};
        for (Vec3& corner : panel) corner -= silhouettes.center;
        return make_shaft(block, panel, scale);
    };
    EXPECT_TRUE(meets_cutout(silhouettes, shaft_from(0)));
    EXPECT_FALSE(meets_cutout(silhouettes, shaft_from(3)));
}

}  // namespace
}  // namespace surimi
