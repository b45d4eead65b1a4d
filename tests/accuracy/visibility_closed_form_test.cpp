// SPDX-License-Identifier: Apache-2.0
// Splitting and scanlines against shadows with closed forms.
#include <gtest/gtest.h>

#include "tests/support/closed_form.h"
#include "tests/support/meshes.h"
#include "tests/support/quadrature.h"
#include "tests/support/scenes.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

using test::Mesh;
using test::Vec3l;
using test::VisibilityJudge;

constexpr double exact = 1e-9 + test::float_ratio;

/// A floor and one panel that has no surface of its own.
struct Stage {
    Scene scene;
    explicit Stage(std::vector<Vec3> panel) {
        test::add_quad(scene, "Floor", {-0.5, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 0, -0.5});
        Monitor monitor;
        monitor.name = "Monitor_R";
        monitor.panels = {{std::move(panel)}};
        scene.monitors.push_back(monitor);
    }
    void add(const Mesh& mesh) { test::add_surface(scene, "Occluder", mesh); }
};

SurfacePoint floor_point(const Scene& scene, double x, double z) {
    SurfacePoint point = surface_point(scene, {0, 0}, {1, 0, 0});
    point.position = {x, 0, z};
    return point;
}

std::vector<Vec3> rectangle(double x, double height, double z, double half_x, double half_z) {
    return {{x - half_x, height, z - half_z},
            {x + half_x, height, z - half_z},
            {x + half_x, height, z + half_z},
            {x - half_x, height, z + half_z}};
}

/// A horizontal strip along z.
Mesh strip(double from, double to, double height, double half_length) {
    return {rectangle(0.5 * (from + to), height, 0, 0.5 * (to - from), half_length), {{0, 1, 2}, {0, 2, 3}}};
}

double irradiance(const std::vector<Vec3l>& corners) {
    return static_cast<double>(test::corner_irradiance(corners, Vec3l(0, 1, 0)));
}

TEST(VisibilityClosedForm, KnifeEdgeCutsThePanelAlongAPlane_M53) {
    Choice choice{Random{21}};
    int penumbra = 0;
    for (int i = 0; i < 200; ++i) {
        const std::vector<Vec3> panel = rectangle(choice.between(-1, 1), 2, choice.between(-1, 1), 0.75, 0.5);
        Stage stage(panel);
        // Everything on one side of the edge from a to b, at different heights.
        const Vec3 a(choice.between(-0.5, 0.5), choice.between(0.8, 1.2), -20),
            b(choice.between(-0.5, 0.5), choice.between(0.8, 1.2), 20), far(-40, 0, 0);
        stage.add({{a, b, b + far, a + far}, {{0, 1, 2}, {0, 2, 3}}});
        const VisibilityJudge judge(stage.scene);
        const SurfacePoint point = floor_point(judge.scene(), choice.between(-0.5, 0.5), choice.between(-0.5, 0.5));
        const Vec3 origin = judge.rays().ray_origin(point);
        const Vec3l from(judge.seen(a) - origin), to(judge.seen(b) - origin), plane = glm::cross(from, to);
        std::vector<Vec3l> whole, open;
        for (const Vec3& corner : panel) whole.push_back(Vec3l(corner - origin));
        for (size_t k = 0; k < 4; ++k) {
            const Vec3l &p = whole[k], &q = whole[(k + 1) % 4];
            const auto dp = glm::dot(plane, p), dq = glm::dot(plane, q);
            if (dp >= 0) open.push_back(p);
            if ((dp > 0) != (dq > 0)) open.push_back(p + (q - p) * (dp / (dp - dq)));
        }
        const double expected = irradiance(open) / irradiance(whole);
        EXPECT_NEAR(judge.split(point), expected, exact) << i;
        EXPECT_NEAR(judge.scanline(point, 0.001), expected, 0.005) << i;
        penumbra += expected > 0.01 && expected < 0.99;
    }
    EXPECT_GT(penumbra, 50);
}

TEST(VisibilityClosedForm, ConvexBoxHidesItsProjectedHull_M53) {
    Choice choice{Random{22}};
    int penumbra = 0;
    for (int i = 0; i < 200; ++i) {
        Stage stage(rectangle(choice.between(-0.5, 0.5), 2.5, choice.between(-0.5, 0.5), 0.75, 0.5));
        const Vec3 center(choice.between(-0.5, 0.5), choice.between(0.6, 1.6), choice.between(-0.5, 0.5));
        const Mesh box = test::box(center, {choice.between(0.1, 1), choice.between(0.1, 1), choice.between(0.1, 1)});
        stage.add(box);
        const VisibilityJudge judge(stage.scene);
        test::Occluder hull;
        for (const Vec3& corner : box.positions) hull.points.push_back(judge.seen(corner));
        const SurfacePoint point = floor_point(judge.scene(), choice.between(-0.5, 0.5), choice.between(-0.5, 0.5));
        const double expected = test::exact_visibility(judge.scene().monitors[0].panels[0],
                                                       judge.rays().ray_origin(point), point.normal, {{hull}});
        EXPECT_NEAR(judge.split(point), expected, exact) << i;
        penumbra += expected > 0.01 && expected < 0.99;
    }
    EXPECT_GT(penumbra, 100);
}

std::vector<Vec3> ring(double radius, double height, int corners) {
    std::vector<Vec3> places;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners;
        places.emplace_back(radius * std::cos(angle), height, radius * std::sin(angle));
    }
    return places;  // counter-clockwise from below, where the receiver is
}

Mesh plate(double radius, double height, int corners) {
    Mesh mesh{ring(radius, height, corners), {}};
    for (uint32_t i = 1; i + 1 < static_cast<uint32_t>(corners); ++i) mesh.triangles.push_back({0, i, i + 1});
    return mesh;
}

/// A wide plate with a round hole in it.
Mesh aperture(double radius, double height, int corners) {
    Mesh mesh{ring(radius, height, corners), {}};
    for (const Vec3& p : ring(20, height, corners)) mesh.positions.push_back(p);
    const auto n = static_cast<uint32_t>(corners);
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t j = (i + 1) % n;
        mesh.triangles.push_back({i, n + i, n + j});
        mesh.triangles.push_back({i, n + j, j});
    }
    return mesh;
}

/// Form factor of a coaxial disk.
double disk(double radius, double height) {
    return radius * radius / (radius * radius + height * height);
}

TEST(VisibilityClosedForm, RoundPlatesHideWhatDisksHide_M53) {
    constexpr double height = 2, radius = 0.75, plate_height = 1;
    for (const double plate_radius : {0.1, 0.2, 0.3, 0.36}) {
        std::array<double, 2> errors{};
        for (size_t finer = 0; finer < 2; ++finer) {
            const int corners = finer ? 128 : 32;
            Stage stage(ring(radius, height, corners));
            stage.add(plate(plate_radius, plate_height, corners));
            const VisibilityJudge judge(stage.scene);
            const SurfacePoint point = floor_point(judge.scene(), 0, 0);
            const double lift = judge.rays().ray_origin(point).y;
            const double expected = 1 - disk(plate_radius, plate_height - lift) / disk(radius, height - lift);
            errors[finer] = std::abs(judge.split(point) - expected);
            EXPECT_NEAR(judge.scanline(point, 0.001), judge.split(point), 0.003);
        }
        EXPECT_LT(errors[1], 2e-4) << plate_radius;  // the n-gons' areas are off by 2 pi^2 / (3 n^2)
        EXPECT_LT(errors[1], errors[0] / 12) << plate_radius;
    }
}

TEST(VisibilityClosedForm, ARoundHoleLetsThroughWhatADiskHides_M53) {
    constexpr double height = 2, radius = 0.75, plate_height = 1;
    Stage stage(ring(radius, height, 128));
    stage.add(aperture(0.25, plate_height, 128));
    const VisibilityJudge judge(stage.scene);
    const double expected = disk(0.25, plate_height) / disk(radius, height);
    EXPECT_NEAR(judge.split(floor_point(judge.scene(), 0, 0)), expected, 2e-4);
    stage.add(plate(0.125, 0.75, 128));  // an annulus is left
    const VisibilityJudge annulus(stage.scene);
    const double left = (disk(0.25, plate_height) - disk(0.125, 0.75)) / disk(radius, height);
    EXPECT_NEAR(annulus.split(floor_point(annulus.scene(), 0, 0)), left, 2e-4);
}

constexpr double half_length = 2000;  // of strips that stand for endless ones: a thousand times the distance

/// Directions are sines of the angle from the floor's normal.
double sine(double x, double height) {
    return x / std::hypot(x, height);
}

TEST(VisibilityClosedForm, EndlessStripsHideBySines_M53) {
    Stage stage(rectangle(0.25, 2, 0, 1, half_length));
    stage.add(strip(-0.5, -0.125, 1, half_length));
    stage.add(strip(0.25, 0.375, 0.75, half_length));
    const VisibilityJudge judge(stage.scene);
    int penumbra = 0;
    for (int i = 0; i < 100; ++i) {
        const double x = -0.49 + 0.98 * i / 99;
        const SurfacePoint point = floor_point(judge.scene(), x, 0);
        const double lift = judge.rays().ray_origin(point).y;
        const double from = sine(-0.75 - x, 2 - lift), to = sine(1.25 - x, 2 - lift);
        double hidden = 0;
        const auto hide = [&](double a, double b, double height) {
            hidden +=
                std::max(0.0, std::min(to, sine(b - x, height - lift)) - std::max(from, sine(a - x, height - lift)));
        };
        hide(-0.5, -0.125, 1);
        hide(0.25, 0.375, 0.75);
        const double overlap = std::max(0.0, std::min(sine(-0.125 - x, 1 - lift), sine(0.375 - x, 0.75 - lift)) -
                                                 std::max(sine(-0.5 - x, 1 - lift), sine(0.25 - x, 0.75 - lift)));
        const double expected = 1 - (hidden - overlap) / (to - from);
        EXPECT_NEAR(judge.split(point), expected, 1e-5) << i;  // (distance / length)^2
        penumbra += expected > 0.01 && expected < 0.99;
    }
    EXPECT_GT(penumbra, 50);
}

TEST(VisibilityClosedForm, CrossedStringsGiveTheExchangeOfStrips_M53) {
    // Receivers from (-0.5, 0) to (0.5, 0), panel above them at a height of 2, and a sheet at 0.75 that ends at x = 0.
    constexpr double height = 2, tip = 0.75;
    Stage stage(rectangle(0, height, 0, 0.5, half_length));
    stage.add(strip(-30, 0, tip, half_length));
    const VisibilityJudge judge(stage.scene);
    constexpr int count = 1024;
    double exchange = 0;  // mean of E / pi over the receivers: the form factor
    for (int i = 0; i < count; ++i) {
        const double x = -0.5 + (i + 0.5) / count;
        const SurfacePoint point = floor_point(judge.scene(), x, 0);
        const double whole = 0.5 * (sine(0.5 - x, height) - sine(-0.5 - x, height));
        exchange += whole * judge.split(point) / count;
    }
    // Strings stay to the right of the tip: left to left and left to right bend around it, the others are straight.
    const double to_tip = std::hypot(0.5, tip), from_tip = std::hypot(0.5, height - tip);
    const double uncrossed = to_tip + from_tip + height;
    const double crossed = to_tip + from_tip + std::hypot(1, height);
    EXPECT_NEAR(exchange, (crossed - uncrossed) / 2, 2e-5);
}

}  // namespace
}  // namespace surimi
