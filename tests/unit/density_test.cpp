// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/density.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "baker/unwrap/reach.h"
#include "baker/unwrap/unwrap.h"

namespace surimi {
namespace {

using Quad = std::array<Vec3, 4>;

/// Corners counter-clockwise seen from the front.
Quad quad(const Vec3& corner, const Vec3& u, const Vec3& v) {
    return {corner, corner + u, corner + u + v, corner + v};
}

void add_quad(Surface& surface, const Quad& corners) {
    const auto first = static_cast<uint32_t>(surface.positions.size());
    surface.positions.insert(surface.positions.end(), corners.begin(), corners.end());
    surface.triangles.push_back({first, first + 1, first + 2});
    surface.triangles.push_back({first, first + 2, first + 3});
}

Surface surface_of(const std::string& name, const std::vector<Quad>& quads) {
    Surface surface;
    surface.name = name;
    for (const Quad& q : quads) add_quad(surface, q);
    return surface;
}

Monitor monitor_of(const std::vector<Quad>& panels, bool is_two_sided = false) {
    Monitor monitor;
    monitor.two_sided = is_two_sided;
    for (const Quad& panel : panels) monitor.panels.push_back({{panel.begin(), panel.end()}});
    return monitor;
}

const Quad screen = quad({-1, 3, 1}, {2, 0, 0}, {0, 0, 1});  // faces -y
const Quad back_of_screen = quad({1, 3, 1}, {-2, 0, 0}, {0, 0, 1});
const Quad floor_of_room = quad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
const Quad wall_behind = quad({-3, 3.1, 0}, {6, 0, 0}, {0, 0, 3});  // faces -y as well
const Quad ground = quad({-100, -100, -1}, {200, 0, 0}, {0, 200, 0});
const Quad room_ceiling = quad({-3, 3, 3}, {6, 0, 0}, {0, -6, 0});  // faces down
const Quad underside = quad({-3, 3, -0.1}, {6, 0, 0}, {0, -6, 0});  // faces down

Scene lit_scene(const std::vector<Surface>& surfaces, const std::vector<Monitor>& monitors) {
    Scene scene;
    scene.surfaces = surfaces;
    scene.monitors = monitors;
    return scene;
}

UnwrapSettings square(int size) {
    UnwrapSettings settings;
    settings.width = settings.height = size;
    return settings;
}

/// Density over the atlas' of the chart that holds a triangle.
double density(const Atlas& atlas, size_t surface, size_t triangle) {
    return atlas.charts[atlas.surfaces[surface].chart[triangle]].texels_per_metre / atlas.texels_per_metre;
}

bool reaches(const Scene& scene, size_t surface) {
    std::vector<uint32_t> faces(scene.surfaces[surface].triangles.size());
    for (uint32_t f = 0; f < faces.size(); ++f) faces[f] = f;
    return is_reached(panel_planes(scene), scene.surfaces[surface], faces);
}

TEST(UnwrapDensity, FarGroundDoesNotEatTheRoom) {
    Scene scene = lit_scene(
        {surface_of("screen", {screen}), surface_of("floor", {floor_of_room}), surface_of("ground", {ground})},
        {monitor_of({screen})});
    scene.surfaces[0].monitor = 0;
    const Atlas atlas = unwrap(scene, square(256), {});
    EXPECT_NEAR(density(atlas, 1, 0), 1, 1e-9);
    EXPECT_LT(density(atlas, 2, 0), 0.1);
    ASSERT_EQ(atlas.weights.size(), 2u);
    EXPECT_EQ(atlas.weights[1].surface, 2u);
    EXPECT_EQ(atlas.weights[1].cause, DensityCause::far);
    EXPECT_NEAR(density(atlas, 2, 0), atlas.weights[1].least, 1e-9);
    EXPECT_LE(atlas.weights[1].texel_share, 0.5);
}

TEST(UnwrapDensity, APlaneWithoutEndTakesABoundedShare) {
    double share = 0.51;
    for (const double side : {100.0, 1000.0, 10000.0}) {
        const Scene scene =
            lit_scene({surface_of("floor", {floor_of_room}),
                       surface_of("ground", {quad({-side, -side, -1}, {2 * side, 0, 0}, {0, 2 * side, 0})})},
                      {monitor_of({screen})});
        const std::vector<DensityWeight> weights = unwrap(scene, square(256), {}).weights;
        ASSERT_EQ(weights.size(), 1u);
        EXPECT_LT(weights[0].texel_share, share);
        share = weights[0].texel_share;
    }
    EXPECT_LT(share, 0.2);
}

TEST(UnwrapDensity, ChartsOfOneMeshAreWeighedOneByOne) {
    const Scene scene =
        lit_scene({surface_of("all", {floor_of_room, ground, wall_behind, underside})}, {monitor_of({screen})});
    const Atlas atlas = unwrap(scene, square(256), {});
    EXPECT_NEAR(density(atlas, 0, 0), 1, 1e-9);
    EXPECT_LT(density(atlas, 0, 2), 0.1);
    EXPECT_NEAR(density(atlas, 0, 4), 0.125, 1e-9);
    EXPECT_NEAR(density(atlas, 0, 6), 0.125, 1e-9);
    ASSERT_EQ(atlas.weights.size(), 2u);
    EXPECT_EQ(atlas.weights[0].cause, DensityCause::unreached);
    EXPECT_EQ(atlas.weights[0].charts, 2u);
    EXPECT_NEAR(atlas.weights[0].area, 18 + 36, 1e-9);
    EXPECT_NEAR(atlas.weights[0].area_share, 54.0 / (40000 + 36 + 54), 1e-9);
}

TEST(UnwrapDensity, AMonitorIsLitByOthersOnly) {
    const Quad opposite = quad({1, -3, 1}, {-2, 0, 0}, {0, 0, 1});  // faces +y
    Scene scene =
        lit_scene({surface_of("screen", {screen}), surface_of("floor", {floor_of_room})}, {monitor_of({screen})});
    scene.surfaces[0].monitor = 0;
    const Atlas alone = unwrap(scene, square(256), {});
    EXPECT_NEAR(density(alone, 0, 0), 0.125, 1e-9);
    EXPECT_NEAR(density(alone, 1, 0), 1, 1e-9);
    scene.monitors.push_back(monitor_of({opposite}));
    EXPECT_TRUE(unwrap(scene, square(256), {}).weights.empty());
}

TEST(UnwrapDensity, WithoutLightNothingIsWeighed) {
    Scene scene = lit_scene({surface_of("floor", {floor_of_room}), surface_of("ground", {ground})}, {});
    EXPECT_TRUE(unwrap(scene, square(256), {}).weights.empty());
    scene.monitors = {monitor_of({quad({-1, 0, -5}, {2, 0, 0}, {0, 1, 0})})};  // below all of it
    EXPECT_TRUE(unwrap(scene, square(256), {}).weights.empty());
}

TEST(UnwrapDensity, UnitsDoNotMatter) {
    const std::vector<Quad> quads{floor_of_room, ground, wall_behind};
    std::vector<double> expected;
    for (const double unit : {1.0, 1e-3, 1e3}) {
        Scene scene = lit_scene({surface_of("all", quads)}, {monitor_of({screen})});
        for (Vec3& p : scene.surfaces[0].positions) p *= unit;
        for (Vec3& p : scene.monitors[0].panels[0].corners) p *= unit;
        const Atlas atlas = unwrap(scene, square(256), {});
        const std::vector<double> densities{density(atlas, 0, 0), density(atlas, 0, 2), density(atlas, 0, 4)};
        if (expected.empty()) expected = densities;
        for (size_t i = 0; i < densities.size(); ++i) EXPECT_NEAR(densities[i], expected[i], 1e-9 * expected[i]);
    }
}

TEST(UnwrapDensity, ThousandsOfPanelsWeighAsTheirWall) {
    const auto ground_density = [](int rows) {  // of the screen in 2 n x n panels
        std::vector<Quad> panels;
        const double side = 1.0 / rows;
        for (int i = 0; i < 2 * rows; ++i)
            for (int j = 0; j < rows; ++j)
                panels.push_back(quad({-1 + i * side, 3, 1 + j * side}, {side, 0, 0}, {0, 0, side}));
        const std::vector<Surface> surfaces{surface_of("all", {floor_of_room, room_ceiling, ground})};
        return density(unwrap(lit_scene(surfaces, {monitor_of(panels)}), square(256), {}), 0, 4);
    };
    const double few = ground_density(5);    // each counts
    const double many = ground_density(40);  // 64 stand for 3200
    EXPECT_LT(few, 0.2);
    EXPECT_NEAR(many, few, 0.1 * few);
}

TEST(UnwrapDensity, TheWishOfTheUserMultiplies) {
    Scene scene = lit_scene({surface_of("all", {floor_of_room, wall_behind})}, {monitor_of({screen})});
    scene.nodes.resize(1);
    scene.nodes[0].name = "Room";
    scene.nodes[0].is_in_scene = true;
    scene.nodes[0].texel_scale = 2;
    const Atlas atlas = unwrap(scene, square(256), {});
    EXPECT_NEAR(density(atlas, 0, 0), 2, 1e-9);
    EXPECT_NEAR(density(atlas, 0, 2), 0.25, 1e-9);
    ASSERT_EQ(atlas.weights.size(), 2u);
    EXPECT_EQ(atlas.weights[0].least, 0.125) << "each cause alone";
    EXPECT_EQ(atlas.weights[1].cause, DensityCause::texel_scale);
    EXPECT_EQ(atlas.weights[1].least, 2);
    EXPECT_EQ(atlas.weights[1].area_share, 1);
}

TEST(UnwrapReach, BehindAndBelowAreNotReached) {
    const auto is_quad_reached = [](const Quad& receiver, bool is_two_sided = false) {
        return reaches(lit_scene({surface_of("receiver", {receiver})}, {monitor_of({screen}, is_two_sided)}), 0);
    };
    EXPECT_TRUE(is_quad_reached(floor_of_room));
    EXPECT_FALSE(is_quad_reached(underside));
    EXPECT_FALSE(is_quad_reached(wall_behind));
    EXPECT_FALSE(is_quad_reached(back_of_screen));
    EXPECT_FALSE(is_quad_reached(screen)) << "in its plane";
    const Quad wall_behind_the_back = quad({3, 3.1, 0}, {-6, 0, 0}, {0, 0, 3});  // faces +y: away from the screen
    EXPECT_FALSE(is_quad_reached(wall_behind_the_back, true));
    EXPECT_TRUE(is_quad_reached(wall_behind, true));
    EXPECT_FALSE(is_quad_reached(screen, true)) << "in its plane";
}

TEST(UnwrapReach, OneCornerInFrontIsEnough) {
    const Quad behind = quad({-3, 3.1, 0}, {6, 0, 0}, {0, 6, 0});  // a floor behind the screen
    Scene scene = lit_scene({surface_of("floor", {behind})}, {monitor_of({screen})});
    EXPECT_FALSE(reaches(scene, 0));
    scene.surfaces[0].positions[0].y = 2.99;
    EXPECT_TRUE(reaches(scene, 0));
    // A floor under the screen, sloping: only where its plane passes below a corner of the screen it sees light.
    for (const double rise : {0.9, 1.1}) {
        const Quad slope = quad({-3, 1, 0}, {6, 0, 0}, {0, 1, rise});  // at the screen, 2 m on, it is at 2 * rise
        scene = lit_scene({surface_of("slope", {slope})}, {monitor_of({screen})});
        EXPECT_EQ(reaches(scene, 0), rise < 1) << rise;
    }
}

/// Random triangles and panels: if any two sample points see each other's front, the triangle is reached, and if it is
/// reached, a corner of each does.
TEST(UnwrapReach, IsExactlyThatSomePairOfPointsSees) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    std::uniform_real_distribution<double> share(0, 1);
    const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
    int reached = 0;
    for (int n = 0; n < 2000; ++n) {
        Surface surface;
        surface.positions = {point(), point(), point()};
        surface.triangles = {{0, 1, 2}};
        const Quad panel = quad(3.0 * point(), point(), point());
        const Scene scene = lit_scene({surface}, {monitor_of({panel})});
        const auto& t = scene.surfaces[0].positions;
        const Vec3 up = glm::normalize(area_normal(t[0], t[1], t[2]));
        const Vec3 front = front_normal(scene.monitors[0].panels[0]);
        const auto sees = [&](const Vec3& from, const Vec3& to, double margin) {
            return glm::dot(up, to - from) > margin && glm::dot(front, from - to) > margin;
        };
        bool do_samples = false;
        for (int i = 0; i < 50; ++i) {
            const double r = share(random);
            const double s = share(random) * (1 - r);
            const Vec3 from = t[0] + r * (t[1] - t[0]) + s * (t[2] - t[0]);
            const Vec3 to = panel[0] + share(random) * (panel[1] - panel[0]) + share(random) * (panel[3] - panel[0]);
            do_samples = do_samples || sees(from, to, 1e-4);
        }
        bool do_corners = false;
        for (const Vec3& from : t)
            for (const Vec3& to : panel) do_corners = do_corners || sees(from, to, 0);
        const bool is_answer_yes = reaches(scene, 0);
        reached += is_answer_yes;
        EXPECT_TRUE(is_answer_yes || !do_samples) << n;
        EXPECT_TRUE(do_corners || !is_answer_yes) << n;
    }
    EXPECT_GT(reached, 500);
    EXPECT_LT(reached, 1500);
}

}  // namespace
}  // namespace surimi
