// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/silhouettes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>
#include <set>

#include "runtime/base/parallel.h"
#include "tests/support/edge_sight.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

using test::Mesh;

Silhouettes silhouettes_of(const Scene& scene) {
    const RayScene rays(scene);
    return find_silhouettes(scene, rays);
}

/// One surface of the triangles as they are, zero areas included.
Scene scene_of_mesh(const Mesh& mesh) {
    Scene scene;
    scene.nodes.emplace_back().name = "mesh";
    Surface& surface = scene.surfaces.emplace_back();
    surface.name = "mesh";
    surface.positions = mesh.positions;
    surface.normals.assign(mesh.positions.size(), Vec3(0, 0, 1));
    surface.triangles = mesh.triangles;
    return scene;
}

Vec3 random_place(std::mt19937& random, double reach) {
    std::uniform_real_distribution<double> along(-reach, reach);
    const double x = along(random), y = along(random), z = along(random);
    return {x, y, z};
}

template <class T>
bool is_same(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST(Silhouettes, ABoxHasTwelveEdgesAndShowsFourOrSixOfThem) {
    Scene scene;
    test::add_box(scene, "box", Vec3(0), Vec3(2, 3, 4));  // 24 vertices: every side has its own
    const Silhouettes found = silhouettes_of(scene);
    EXPECT_EQ(found.planes.size(), 6u);
    ASSERT_EQ(found.edges.size(), 12u);
    std::mt19937 random(1);
    std::set<long> seen;
    for (int i = 0; i < 300; ++i) {
        const Vec3 p = random_place(random, 10);
        const bool is_inside = std::abs(p.x) < 1 && std::abs(p.y) < 1.5 && std::abs(p.z) < 2;
        const long count = std::count_if(found.edges.begin(), found.edges.end(),
                                         [&](const Edge& edge) { return test::jump_at(found, edge, p) != 0; });
        if (is_inside) {
            EXPECT_EQ(count, 0);
        } else {
            seen.insert(count);
        }
    }
    EXPECT_EQ(seen, (std::set<long>{4, 6}));
}

TEST(Silhouettes, CoplanarQuadsHaveNoInnerEdges) {
    Mesh grid;
    constexpr uint32_t n = 10;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) grid.positions.emplace_back(0.3 * i, 0.7, 0.1 * j);
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            grid.triangles.push_back({a, b, c});
            grid.triangles.push_back({a, c, d});
        }
    const Silhouettes found = silhouettes_of(scene_of_mesh(grid));
    EXPECT_EQ(found.planes.size(), 1u);
    EXPECT_EQ(found.edges.size(), 4 * n);
    for (const Edge& edge : found.edges) EXPECT_FALSE(edge.has_second());
}

TEST(Silhouettes, ATurnedQuadIsOneFacet) {
    Scene scene;
    const Vec3 u = glm::normalize(Vec3(1, 0.37, -0.2)), v = glm::normalize(glm::cross(u, Vec3(0.3, 1, 0.1)));
    const Vec3 c(1.7, 2.3, -0.9);
    test::add_quad(scene, "quad", c - u - v, c + u - v, c + u + v, c - u + v);
    test::add_box(scene, "far", Vec3(5, 5, 5), Vec3(1));
    const Silhouettes found = silhouettes_of(scene);
    EXPECT_EQ(found.planes.size(), 7u);
    EXPECT_EQ(found.edges.size(), 16u);
    EXPECT_EQ(found.plane_of[0][0], found.plane_of[0][1]);
}

TEST(Silhouettes, FacetsDoNotDriftAlongASlowCurve) {
    Mesh curve;  // neighbours differ by 5e-7 only, the ends by 2e-3
    constexpr uint32_t strips = 4000;
    for (uint32_t i = 0; i <= strips; ++i) {
        const double x = 0.5 * i - 1000;
        curve.positions.emplace_back(x, 0, 5e-7 * x * x);
        curve.positions.emplace_back(x, 1, 5e-7 * x * x);
    }
    for (uint32_t i = 0; i < strips; ++i) {
        curve.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        curve.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    const Scene scene = scene_of_mesh(curve);
    const Silhouettes found = silhouettes_of(scene);
    EXPECT_GT(found.planes.size(), 500u);
    for (size_t t = 0; t < curve.triangles.size(); ++t)
        for (const uint32_t corner : curve.triangles[t]) {
            const FacePlane& plane = found.planes[found.plane_of[0][t]];
            const Vec3 place(Vec3f(curve.positions[corner] - found.center));
            ASSERT_NEAR(glm::dot(plane.normal, place), plane.distance, 1000 * std::numeric_limits<float>::epsilon());
        }
}

/// Sum of the jumps of all edges that lie on the x axis, taken along it.
int jump_along_x(const Silhouettes& found, const Vec3& p, double x) {
    int sum = 0;
    for (const Edge& edge : found.edges) {
        const double a = edge.a.x + found.center.x, b = edge.b.x + found.center.x;
        const bool is_on_axis =
            std::abs(edge.a.y + found.center.y) < 1e-6 && std::abs(edge.b.y + found.center.y) < 1e-6;
        if (!is_on_axis || x < std::min(a, b) || x > std::max(a, b)) continue;
        sum += (b > a ? 1 : -1) * test::jump_at(found, edge, p - found.center);
    }
    return sum;
}

TEST(Silhouettes, TheEdgesOfATJunctionCancel) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0, 0}, {0, -1, 0}, {2, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 4, 3}, {4, 5, 3}, {5, 1, 3}};  // the upper one does not know the vertex at (1, 0)
    const Silhouettes found = silhouettes_of(scene_of_mesh(mesh));
    EXPECT_EQ(found.edges.size(), 3u + 5u);
    for (const double x : {0.5, 1.5})
        for (const double z : {-3.0, 3.0}) EXPECT_EQ(jump_along_x(found, Vec3(0.3, 0.2, z), x), 0);
    EXPECT_NE(test::jump_at(found, found.edges[0], Vec3(0, 0, 3)), 0);
}

TEST(Silhouettes, ADoubledFaceCountsTwice) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 2, 0}};
    const Silhouettes found = silhouettes_of(scene_of_mesh(mesh));
    ASSERT_EQ(found.edges.size(), 3u);
    for (const Edge& edge : found.edges) {
        EXPECT_TRUE(edge.runs_alike());
        EXPECT_EQ(test::jump_at(found, edge, Vec3(0, 0, 1)), 2);
        EXPECT_EQ(test::jump_at(found, edge, Vec3(0, 0, -1)), -2);
    }
}

TEST(Silhouettes, ASheetOfTwoSidesCancelsItself) {
    Mesh mesh;  // the same triangle from both sides: closed, without volume
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
    const Silhouettes found = silhouettes_of(scene_of_mesh(mesh));
    ASSERT_EQ(found.edges.size(), 3u);
    for (const Edge& edge : found.edges) EXPECT_EQ(std::abs(test::jump_at(found, edge, Vec3(0.2, 0.1, 1))), 2);
}

TEST(Silhouettes, NeighboursOfMirroredWindingHideTheirEdge) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    const Silhouettes found = silhouettes_of(scene_of_mesh(mesh));
    ASSERT_EQ(found.edges.size(), 5u);
    const auto shared =
        std::find_if(found.edges.begin(), found.edges.end(), [](const Edge& e) { return e.has_second(); });
    ASSERT_NE(shared, found.edges.end());
    EXPECT_TRUE(shared->runs_alike());
    for (const double z : {-1.0, 1.0}) EXPECT_EQ(test::jump_at(found, *shared, Vec3(0.1, 0.2, z)), 0);
}

TEST(Silhouettes, AFanHasOneRecordForEachFace) {
    const Mesh fan = test::book();  // three pages
    const Silhouettes found = silhouettes_of(scene_of_mesh(fan));
    std::vector<std::array<float, 6>> spans;
    for (const Edge& edge : found.edges) {
        std::array<float, 3> a{edge.a.x, edge.a.y, edge.a.z}, b{edge.b.x, edge.b.y, edge.b.z};
        if (b < a) std::swap(a, b);
        spans.push_back({a[0], a[1], a[2], b[0], b[1], b[2]});
    }
    size_t threefold = 0;
    for (size_t e = 0; e < spans.size(); ++e) {
        const auto count = std::count(spans.begin(), spans.end(), spans[e]);
        EXPECT_TRUE(count == 1 || count == 3);
        if (count != 3) continue;
        EXPECT_FALSE(found.edges[e].has_second());
        ++threefold;
    }
    EXPECT_GT(threefold, 0u);
}

TEST(Silhouettes, TrianglesWithoutAreaHaveNoPlaneAndNoEdges) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 0, 1e-12}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 1}, {1, 4, 2}};  // in a line; repeated; no area once rounded
    for (const double x : {100.0, 101.0, 102.0}) mesh.positions.emplace_back(x, x * x, 100);
    mesh.triangles.push_back({5, 6, 7});  // so that the scene's centre is far away, where 1e-12 is nothing
    const Silhouettes found = silhouettes_of(scene_of_mesh(mesh));
    EXPECT_EQ(found.edges.size(), 6u);
    EXPECT_EQ(found.plane_of[0], (std::vector<uint32_t>{0, Edge::no_plane, Edge::no_plane, Edge::no_plane, 1}));
}

TEST(Silhouettes, SliversKeepTheirEdges) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}, {0.5, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    const Silhouettes found = silhouettes_of(scene_of_mesh(mesh));
    EXPECT_EQ(found.planes.size(), 1u);
    EXPECT_EQ(found.edges.size(), 4u);
}

TEST(Silhouettes, PlusAndMinusZeroAreOnePlace) {
    Mesh mesh;
    mesh.positions = {{0.0, -1, 0}, {0.0, 1, 0}, {1, 0, 0}, {-0.0, -1, -0.0}, {-0.0, 1, 0}, {-1, 0, 0}};
    mesh.triangles = {{0, 2, 1}, {3, 4, 5}};
    const Silhouettes found = silhouettes_of(scene_of_mesh(mesh));
    EXPECT_EQ(found.edges.size(), 4u);
}

TEST(Silhouettes, AMonitorIsNotWeldedToItsWall) {
    Scene scene;
    test::add_quad(scene, "wall", {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    test::add_monitor(scene, "Monitor", 0, {1.5, 0.5, 0}, {0.5, 0, 0}, {0, 0.5, 0});  // shares the edge at x = 1
    const Silhouettes found = silhouettes_of(scene);
    ASSERT_EQ(found.edges.size(), 8u);
    EXPECT_EQ(std::count_if(found.edges.begin(), found.edges.end(), [](const Edge& e) { return e.owner() == 0; }), 4);
    EXPECT_EQ(std::count_if(found.edges.begin(), found.edges.end(),
                            [](const Edge& e) { return e.owner() == Edge::ordinary; }),
              4);
}

TEST(Silhouettes, APanelWithoutASurfaceHidesAsRaysSeeIt) {
    Scene scene;
    test::add_quad(scene, "floor", {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
    Monitor& monitor = scene.monitors.emplace_back();
    monitor.panels.push_back({{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}});
    const Silhouettes found = silhouettes_of(scene);
    EXPECT_EQ(std::count_if(found.edges.begin(), found.edges.end(), [](const Edge& e) { return e.owner() == 0; }), 4);
    ASSERT_EQ(found.plane_of.size(), 2u);
    ASSERT_EQ(found.plane_of[1].size(), 2u);
    EXPECT_EQ(found.plane_of[1][0], found.plane_of[1][1]);
}

TEST(Silhouettes, AlphaMaskedTrianglesAreCutouts) {
    Scene scene;
    test::add_box(scene, "box", Vec3(0), Vec3(1));
    const uint32_t leaf = test::add_quad(scene, "leaf", {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2});
    scene.materials.emplace_back().alpha_mode = AlphaMode::mask;
    scene.surfaces[leaf].material = 0;
    const Silhouettes found = silhouettes_of(scene);
    EXPECT_EQ(found.edges.size(), 12u);
    EXPECT_EQ(found.cutouts.size(), 2u);
    EXPECT_FALSE(found.cutout_nodes.empty());
    EXPECT_EQ(found.plane_of[leaf], (std::vector<uint32_t>{Edge::no_plane, Edge::no_plane}));
}

TEST(Silhouettes, AnEmptySceneHasNone) {
    const Silhouettes found = silhouettes_of(Scene{});
    EXPECT_TRUE(found.edges.empty());
    EXPECT_TRUE(found.nodes.empty());
}

TEST(Silhouettes, ThreadsDoNotChangeAByte) {
    const Scene scene = test::scene_of({test::terrain(60), test::torus(80, 40), test::foliage(3000), test::walls(),
                                        test::mixed_winding(), test::degenerate_grid()});
    set_thread_count(1);
    const Silhouettes one = silhouettes_of(scene);
    set_thread_count(4);
    const Silhouettes four = silhouettes_of(scene);
    set_thread_count(0);
    ASSERT_GT(one.edges.size(), 10000u);
    EXPECT_TRUE(is_same(one.edges, four.edges));
    EXPECT_TRUE(is_same(one.nodes, four.nodes));
    EXPECT_TRUE(is_same(one.planes, four.planes));
    EXPECT_EQ(one.plane_of, four.plane_of);
}

TEST(Silhouettes, TheTreeHoldsEveryEdgeOnce) {
    const Silhouettes found = silhouettes_of(test::scene_of({test::terrain(40), test::needle_fan()}));
    std::vector<int> seen(found.edges.size(), 0);
    for (const EdgeNode& node : found.nodes) {
        ASSERT_LE(node.count, 8u);
        for (uint32_t e = node.first; e < node.first + node.count; ++e) {
            ++seen[e];
            for (const Vec3f& end : {found.edges[e].a, found.edges[e].b})
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_LE(node.low[axis], end[axis]);
                    EXPECT_GE(node.high[axis], end[axis]);
                }
        }
    }
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
}

TEST(Silhouettes, AMillionEdgesInOnePlaceStillMakeATree) {
    Silhouettes same;
    same.planes.resize(1);
    Edge edge;
    edge.a = edge.b = Vec3f(1);
    edge.second_and_sense = Edge::no_plane;
    same.edges.assign(1000000, edge);
    build_tree(same);
    EXPECT_GT(same.nodes.size(), 1000000u / 8);
}

TEST(Silhouettes, TakeEightyBytesAnEdgeAtMost) {
    for (const Mesh& mesh : {test::terrain(200), test::ico_sphere(6), test::torus(300, 150), test::foliage(20000)}) {
        const Silhouettes found = silhouettes_of(test::scene_of({mesh}));
        size_t bytes = found.edges.capacity() * sizeof(Edge) + found.nodes.capacity() * sizeof(EdgeNode) +
                       found.planes.capacity() * sizeof(FacePlane);
        for (const auto& planes : found.plane_of) bytes += planes.capacity() * sizeof(uint32_t);
        EXPECT_LE(static_cast<double>(bytes) / static_cast<double>(found.edges.size()), 80.0);
    }
}

/// The number of surfaces that a walk from q to r along the panel gains, by the jumps of the edges that it crosses.
int gained(const Silhouettes& found, const Vec3& p, const Vec3& q, const Vec3& r) {
    int sum = 0;
    for (const Edge& edge : found.edges) {
        const Vec3 a = Vec3(edge.a) - p, b = Vec3(edge.b) - p, across = glm::cross(a, b);
        const double from = glm::dot(across, q - p), to = glm::dot(across, r - p);
        if ((from > 0) == (to > 0)) continue;
        const Vec3 way = glm::mix(q, r, from / (from - to)) - p;  // in the plane of a and b
        const double length = glm::dot(across, across);
        const double at_a = glm::dot(glm::cross(way, b), across) / length;
        const double at_b = glm::dot(glm::cross(a, way), across) / length;
        // way = at_a a + at_b b; the panel lies behind the edge where the sum exceeds 1
        if (at_a > 0 && at_b > 0 && at_a + at_b > 1) sum += (from > 0 ? 1 : -1) * test::jump_at(found, edge, p);
    }
    return sum;
}

TEST(Silhouettes, JumpsAddUpToDepthComplexity_M50) {
    std::mt19937 random(50);
    for (const Mesh& mesh : {test::torus(24, 12), test::book(), test::mixed_winding(), test::touching_cubes(),
                             test::foliage(200), test::walls(), test::degenerate_grid(), test::moebius()}) {
        const Scene scene = scene_of_mesh(mesh);
        const Silhouettes found = silhouettes_of(scene);
        double reach = 0;
        for (const Edge& edge : found.edges) reach = std::max<double>(reach, glm::length(edge.a));
        int changes = 0;
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = random_place(random, 0.8 * reach);
            const Vec3 q(random_place(random, 2 * reach).x, random_place(random, 2 * reach).y, 2 * reach);
            const Vec3 r(random_place(random, 2 * reach).x, random_place(random, 2 * reach).y, 2 * reach);
            const int difference =
                test::depth_complexity(scene, found.center, p, r) - test::depth_complexity(scene, found.center, p, q);
            EXPECT_EQ(gained(found, p, q, r), difference);
            changes += difference != 0 ? 1 : 0;
        }
        EXPECT_GT(changes, 5);
    }
}

}  // namespace
}  // namespace surimi
