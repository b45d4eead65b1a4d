// SPDX-License-Identifier: Apache-2.0
// Light along coarse smooth bodies, against the round ones that they stand for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "baker/gather/gather.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr double radius = 0.5, height = 1;
constexpr uint32_t map_width = 128, map_height = 16;
constexpr double level = 1.0 / 255;  // of an 8-bit map
constexpr double asked = 0.002;      // error of visibility

/// All texels of the first surface.
std::vector<IrradianceEstimate> bake_first(const Scene& scene, Atlas atlas, bool lifts_smooth) {
    atlas.surfaces.resize(scene.surfaces.size());
    Scene alone = scene;
    for (size_t s = 1; s < alone.surfaces.size(); ++s) alone.surfaces[s].triangles.clear();
    const Texels texels = find_texels(alone, atlas);
    const RayScene rays(scene);
    const GatherSettings settings{.error = asked, .lifts_smooth = lifts_smooth};
    return gather(scene, atlas, texels, rays, find_silhouettes(scene, rays), 0, settings, {}).estimates;
}

/// The side of a cylinder about the y axis, one chart on all of the map, with the normals of the round one; `outward`
/// is -1 for the inside of a tube. A facet faces +x.
struct Cylinder {
    Scene scene;
    Atlas atlas;

    explicit Cylinder(uint32_t sides, double outward = 1) {
        const uint32_t index = test::add_quad(scene, "Cylinder", {}, {}, {}, {});
        Surface& surface = scene.surfaces[index];
        surface.positions.clear(), surface.normals.clear(), surface.triangles.clear();
        surface.source_triangle.clear(), surface.source_vertex.clear();
        SurfaceUv& uv = atlas.surfaces.emplace_back();
        const auto share = [&](uint32_t i) { return static_cast<double>(i) / sides; };
        for (uint32_t i = 0; i <= sides; ++i)
            for (const double y : {0.0, height}) {
                const double angle = 2 * pi * (share(i) + 1.0 / 16);
                const Vec3 normal(std::cos(angle), 0, std::sin(angle));
                surface.positions.push_back(radius * normal + Vec3(0, y, 0));
                surface.normals.push_back(outward * normal);
            }
        for (uint32_t i = 0; i < sides; ++i) {
            const uint32_t a = 2 * i;
            for (std::array<uint32_t, 3> t : {std::array{a, a + 1, a + 3}, std::array{a, a + 3, a + 2}}) {
                if (outward < 0) std::swap(t[1], t[2]);
                surface.triangles.push_back(t);
                const auto on_map = [&](uint32_t v) { return Vec2f(Vec2(share(v / 2), v % 2)); };
                uv.uv.push_back({on_map(t[0]), on_map(t[1]), on_map(t[2])});
                uv.chart.push_back(0);
            }
        }
        atlas.charts.push_back({index, 40});
        atlas.width = map_width, atlas.height = map_height;
    }
    void add_monitor(const Vec3& center) { test::add_monitor(scene, "Monitor_R", 0, center, {0, 0, 0.6}, {0, 0.4, 0}); }

    std::vector<IrradianceEstimate> baked(bool lifts_smooth) const { return bake_first(scene, atlas, lifts_smooth); }
};

double visibility(const IrradianceEstimate& e) {
    return static_cast<double>(e.shadowed) / static_cast<double>(e.unshadowed);
}

/// An icosphere with normals averaged by area; each triangle is a chart of 12 x 12 texels.
struct Sphere {
    Scene scene;
    Atlas atlas;

    explicit Sphere(int subdivisions) : scene(test::scene_of({test::scaled(test::ico_sphere(subdivisions), 0.5)})) {
        SurfaceUv& uv = atlas.surfaces.emplace_back();
        const auto count = static_cast<uint32_t>(scene.surfaces[0].triangles.size());
        const auto cells = static_cast<uint32_t>(std::ceil(std::sqrt(count)));
        constexpr float cell = 16, inset = 2;
        for (uint32_t i = 0; i < count; ++i) {
            const Vec2f low(cell * static_cast<float>(i % cells) + inset, cell * static_cast<float>(i / cells) + inset);
            const float side = cell - 2 * inset, map = cell * static_cast<float>(cells);
            uv.uv.push_back({low / map, (low + Vec2f(side, 0)) / map, (low + Vec2f(0, side)) / map});
            uv.chart.push_back(i);
            atlas.charts.push_back({0, 40});
        }
        atlas.width = atlas.height = 16 * static_cast<int>(cells);
        test::add_monitor(scene, "Monitor_R", 0, {2, 0.4, 0}, {0, 0, 0.6}, {0, 0.4, 0});
    }
    std::vector<IrradianceEstimate> baked(bool lifts_smooth) const { return bake_first(scene, atlas, lifts_smooth); }
};

/// How far texels with light are from what they should be.
struct Distance {
    int lit = 0;
    double beyond = 0;  ///< share of them that is off by more than a level
    double largest = 0;
    double rmse = 0;  ///< weighted by irradiance
};

template <class Truth>
Distance distance(const std::vector<IrradianceEstimate>& estimates, const Truth& truth) {
    Distance d;
    double squares = 0, light = 0;
    for (size_t i = 0; i < estimates.size(); ++i) {
        const double expected = truth(i);
        const auto weight = static_cast<double>(estimates[i].unshadowed);
        if (!(weight > 0) || !(expected >= 0)) continue;
        const double off = std::abs(visibility(estimates[i]) - expected);
        ++d.lit;
        d.beyond += off > level;
        d.largest = std::max(d.largest, off);
        squares += weight * off * off;
        light += weight;
    }
    d.beyond /= std::max(d.lit, 1);
    d.rmse = std::sqrt(squares / light);
    return d;
}

template <class Body>
Distance from_open(const Body& body, bool lifts_smooth) {
    return distance(body.baked(lifts_smooth), [](size_t) { return 1.0; });
}

void record(const std::string& name, const Distance& d) {
    char text[120];
    std::snprintf(text, sizeof text, "%d lit, beyond %.4f, largest %.4f, rmse %.5f", d.lit, d.beyond, d.largest,
                  d.rmse);
    testing::Test::RecordProperty(name, text);
}

/// On a convex body all light above the shading horizon arrives: V = 1 wherever there is light.
template <class Body>
void expect_open(const std::string& name, const Body& body) {
    const Distance before = from_open(body, false), after = from_open(body, true);
    record(name + "_before", before);
    record(name + "_after", after);
    EXPECT_GT(after.lit, 500) << name;
    EXPECT_GT(before.beyond, 0.02) << name;
    EXPECT_EQ(after.beyond, 0) << name;
    EXPECT_LE(after.largest, asked) << name;
}

TEST(Terminator, ACylinderHidesNothingOfItsLight_M63) {
    for (const uint32_t sides : {6u, 8u, 16u, 64u, 512u}) {
        Cylinder cylinder(sides);
        cylinder.add_monitor({2, 0.5, 0});
        expect_open("sides_" + std::to_string(sides), cylinder);
    }
}

TEST(Terminator, ASphereHidesNothingOfItsLight_M63) {
    for (const int subdivisions : {1, 2}) expect_open("sphere_" + std::to_string(subdivisions), Sphere(subdivisions));
}

TEST(Terminator, ShadowsOfOthersAreThoseOnTheRoundOne_M63) {
    const auto shadowed = [](uint32_t sides) {
        Cylinder cylinder(sides);
        cylinder.add_monitor({2, 0.5, 0});
        test::add_quad(cylinder.scene, "Wall", {1, -1, 0}, {1, 2, 0}, {1, 2, 1}, {1, -1, 1});
        return cylinder;
    };
    const std::vector<IrradianceEstimate> fine = shadowed(512).baked(true);
    int partly = 0;
    const auto expected = [&](size_t i) {
        const double v = fine[i].unshadowed > 0 ? visibility(fine[i]) : -1;
        partly += v > 0.1 && v < 0.9;
        return v;
    };
    for (const uint32_t sides : {8u, 16u, 64u}) {
        const Distance before = distance(shadowed(sides).baked(false), expected);
        const Distance after = distance(shadowed(sides).baked(true), expected);
        record("wall_" + std::to_string(sides) + "_before", before);
        record("wall_" + std::to_string(sides) + "_after", after);
        // A texel lies where its chord says, not its arc: by up to `slip` beside the fine one's. The penumbra is
        // monitor width times 1/2 wide, and V falls nowhere more than twice as fast as over that on average.
        const double a = pi / sides;
        double slip = 0;
        for (double t = 0; t < 1; t += 0.01)
            slip = std::max(slip, radius * std::abs(std::atan(t * std::tan(a)) - t * a));
        EXPECT_LE(after.largest, 2 * slip / 0.6 + 2 * asked) << sides;
        EXPECT_LT(after.rmse, before.rmse / 5) << sides;
    }
    EXPECT_GT(partly, 1000);
}

TEST(Terminator, AHollowBodyKeepsItsBytes_M63) {
    Cylinder tube(16, -1);
    tube.add_monitor({0.3, 0.5, 0});
    tube.scene.monitors[0].panels[0].corners = {{0.3, 0.3, 0.1}, {0.3, 0.3, -0.1}, {0.3, 0.7, -0.1}, {0.3, 0.7, 0.1}};
    const auto before = tube.baked(false), after = tube.baked(true);
    int lit = 0;
    for (size_t i = 0; i < before.size(); ++i) {
        lit += before[i].unshadowed > 0;
        ASSERT_EQ(before[i].unshadowed, after[i].unshadowed) << i;
        ASSERT_EQ(before[i].shadowed, after[i].shadowed) << i;
    }
    EXPECT_GT(lit, 500);
}

TEST(Terminator, APlateUponAFacetStaysInTheWay_M63) {
    // A facet of an octagon faces the monitor; its middle would move by 38 mm, through the plate.
    Cylinder cylinder(8);
    cylinder.add_monitor({2, 0.5, 0});
    const double x = radius * std::cos(pi / 8) + 0.001;
    test::add_quad(cylinder.scene, "Plate", {x, 0.2, -0.1}, {x, 0.8, -0.1}, {x, 0.8, 0.1}, {x, 0.2, 0.1});
    const auto estimates = cylinder.baked(true);
    int covered = 0;
    for (uint32_t column = 0; column < map_width; ++column)
        for (uint32_t row = 0; row < map_height; ++row) {
            // One facet is 16 columns wide, this the last; 20 mm within the plate's rim only light below 3 degrees gets
            // under it.
            const double side = 2 * radius * std::sin(pi / 8), y = (row + 0.5) / map_height * height;
            const double z = ((column + 0.5 - 112) / 16 - 0.5) * side;
            if (std::abs(z) > 0.06 || y < 0.26 || y > 0.74) continue;
            ++covered;
            const IrradianceEstimate& e = estimates[row * map_width + column];
            EXPECT_GT(e.unshadowed, 0);
            EXPECT_EQ(e.shadowed, 0) << column << ' ' << row;
        }
    EXPECT_GT(covered, 20);
}

}  // namespace
}  // namespace surimi
