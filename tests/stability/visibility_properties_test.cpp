// SPDX-License-Identifier: Apache-2.0
// What must hold for visibility without knowing its value.
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

using test::Mesh;
using test::VisibilityJudge;

constexpr double same = 2 * test::float_ratio;  // two results in float

/// Occluders over a floor, and panels without a surface above.
struct Stage {
    std::vector<Mesh> occluders;
    std::vector<Polygon> panels;
};

Mesh turned(Mesh mesh, const Vec3& center, const Vec3& axis, double angle) {
    for (Vec3& p : mesh.positions) {  // Rodrigues' rotation
        const Vec3 d = p - center;
        p = center + std::cos(angle) * d + std::sin(angle) * glm::cross(axis, d) +
            (1 - std::cos(angle)) * glm::dot(axis, d) * axis;
    }
    return mesh;
}

Mesh sheet(const Vec3& corner, const Vec3& u, const Vec3& v, int cells = 1) {
    Mesh mesh;
    const auto n = static_cast<uint32_t>(cells);
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) mesh.positions.push_back(corner + u * (1.0 * i / n) + v * (1.0 * j / n));
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    return mesh;
}

/// Three boxes, one of them turned, and two sheets.
Stage usual_stage() {
    Stage stage;
    stage.panels = {{{{-0.75, 2.5, -0.5}, {0.75, 2.5, -0.5}, {0.75, 2.375, 0.5}, {-0.75, 2.375, 0.5}}}};
    stage.occluders = {test::box({0.5, 0.75, 0.25}, {0.5, 0.5, 0.75}), test::box({-0.75, 1.25, -0.5}, {0.25, 0.5, 0.5}),
                       turned(test::box({0, 1.5, 0.75}, {0.5, 0.25, 0.75}), {0, 1.5, 0.75}, {0.6, 0, 0.8}, 0.7),
                       sheet({-1, 0.75, 0}, {0.75, 0.25, 0}, {0, 0.125, 0.75}),
                       sheet({0.25, 1.75, -1}, {0.5, 0, 0}, {0, 0, 1})};
    return stage;
}

using Motion = std::function<Vec3(const Vec3&)>;

Scene scene_of(const Stage& stage, const Motion& move) {
    Scene scene;
    test::add_quad(scene, "Floor", move({-1.5, 0, 1.5}), move({1.5, 0, 1.5}), move({1.5, 0, -1.5}),
                   move({-1.5, 0, -1.5}));
    for (Mesh mesh : stage.occluders) {
        for (Vec3& p : mesh.positions) p = move(p);
        test::add_surface(scene, "Occluder", mesh);
    }
    Monitor monitor;
    monitor.name = "Monitor_R";
    monitor.panels = stage.panels;
    for (Polygon& panel : monitor.panels)
        for (Vec3& corner : panel.corners) corner = move(corner);
    scene.monitors.push_back(monitor);
    return scene;
}

Vec3 as_it_is(const Vec3& p) {
    return p;
}

/// At 200 points of the floor, the same ones whatever is done to the scene.
std::vector<double> visibilities(const Stage& stage, const Motion& move = as_it_is) {
    const VisibilityJudge judge(scene_of(stage, move));
    std::vector<double> values;
    Choice choice{Random{31}};
    for (uint32_t i = 0; i < 200; ++i) {
        const double u = std::sqrt(choice.random.next()), v = choice.random.next();
        values.push_back(judge.split(surface_point(judge.scene(), {0, i % 2}, {1 - u, u * (1 - v), u * v})));
    }
    return values;
}

size_t penumbra(const std::vector<double>& values) {
    size_t count = 0;
    for (const double v : values) count += v > 0.01 && v < 0.99;
    return count;
}

void expect_equal(const std::vector<double>& values, const std::vector<double>& others, double tolerance) {
    EXPECT_GT(penumbra(values), 100u);
    for (size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], others[i], tolerance) << i;
}

TEST(VisibilityProperties, NothingInTheWayIsExactlyOne) {
    Stage stage = usual_stage();
    stage.occluders.clear();
    for (const double v : visibilities(stage)) EXPECT_EQ(v, 1);
}

TEST(VisibilityProperties, AnEmptyConvexRoomIsExactlyOneEverywhere) {
    Scene room;
    test::add_box(room, "Room", {0, 1.5, 0}, {4, 3, 4}, true);
    test::add_monitor(room, "Monitor_R", 0, {0, 1.5, -1.99}, {0.75, 0, 0}, {0, 0.5, 0});
    const VisibilityJudge judge(std::move(room));
    Choice choice{Random{32}};
    size_t lit = 0;
    for (int i = 0; i < 1000; ++i) {
        const SurfacePoint point = test::random_point(judge.scene(), choice, 0);
        const double value = judge.split(point), line = judge.scanline(point, 0.004);
        EXPECT_TRUE(value == 1 || value == 0) << value;
        EXPECT_EQ(value, line);
        EXPECT_EQ(value, judge.truth(point).visibility() > 0.5 ? 1 : 0);
        lit += value == 1;
    }
    EXPECT_GT(lit, 600u);
}

TEST(VisibilityProperties, AClosedBoxIsExactlyZero) {
    Stage stage = usual_stage();
    stage.occluders.push_back(test::box({0, 0.25, 0}, {3.5, 0.75, 3.5}));
    for (const double v : visibilities(stage)) EXPECT_EQ(v, 0);
    Scene scene = scene_of(stage, as_it_is);
    const VisibilityJudge judge(std::move(scene));
    for (uint32_t i = 0; i < 2; ++i)
        EXPECT_EQ(judge.scanline(surface_point(judge.scene(), {0, i}, Vec3(1.0 / 3)), 0.004), 0);
}

TEST(VisibilityProperties, ASheetAndItsComplementHideEverythingOnce) {
    const Mesh whole = sheet({-4, 1.25, -4}, {8, 0, 0}, {0, 0.25, 8}, 64);
    Stage some = usual_stage(), rest = some;
    some.occluders = rest.occluders = {{whole.positions, {}}};
    Choice choice{Random{33}};
    for (size_t t = 0; t < whole.triangles.size(); t += 2)
        for (Stage* stage : {choice.random.next() < 0.5 ? &some : &rest})
            for (size_t half = 0; half < 2; ++half) stage->occluders[0].triangles.push_back(whole.triangles[t + half]);
    const std::vector<double> a = visibilities(some), b = visibilities(rest);
    EXPECT_GT(penumbra(a), 150u);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i] + b[i], 1, 1e-9 + same) << i;
}

TEST(VisibilityProperties, MoreOccludersNeverLetMoreThrough) {
    Stage stage = usual_stage();
    const std::vector<Mesh> all = stage.occluders;
    stage.occluders.clear();
    std::vector<double> before = visibilities(stage);
    size_t less = 0;
    for (const Mesh& mesh : all) {
        stage.occluders.push_back(mesh);
        const std::vector<double> after = visibilities(stage);
        for (size_t i = 0; i < after.size(); ++i) {
            EXPECT_LE(after[i], before[i] + 1e-9 + same) << i;
            less += after[i] < before[i] - 0.01;
        }
        before = after;
    }
    EXPECT_GT(less, 200u);
}

TEST(VisibilityProperties, ShadowsThatDoNotOverlapAdd) {
    Stage left = usual_stage(), right = left, both = left;
    const Mesh a = sheet({-0.5, 2, -0.5}, {0.25, 0, 0}, {0, 0, 1}), b = sheet({0.25, 2, -0.5}, {0.25, 0, 0}, {0, 0, 1});
    left.occluders = {a};
    right.occluders = {b};
    both.occluders = {a, b};  // in one plane
    const std::vector<double> l = visibilities(left), r = visibilities(right), together = visibilities(both);
    EXPECT_GT(penumbra(together), 100u);
    for (size_t i = 0; i < l.size(); ++i) EXPECT_NEAR(2 - l[i] - r[i], 1 - together[i], 1e-9 + 2 * same) << i;
}

TEST(VisibilityProperties, FinerTrianglesOfTheSameSurfaceChangeNothing) {
    Stage coarse = usual_stage(), fine = coarse;
    coarse.occluders = {sheet({-1, 0.75, 0}, {0.75, 0.25, 0}, {0, 0.125, 0.75}),
                        sheet({0.25, 1.75, -1}, {0.5, 0, 0}, {0, 0, 1})};
    fine.occluders = {sheet({-1, 0.75, 0}, {0.75, 0.25, 0}, {0, 0.125, 0.75}, 16),
                      sheet({0.25, 1.75, -1}, {0.5, 0, 0}, {0, 0, 1}, 8)};
    expect_equal(visibilities(coarse), visibilities(fine), 1e-5);  // new vertices are rounded to float
}

TEST(VisibilityProperties, DoubledFacesChangeNothing) {
    const Stage once = usual_stage();
    Stage twice = once;
    twice.occluders.insert(twice.occluders.end(), once.occluders.begin(), once.occluders.end());
    for (Mesh& mesh : twice.occluders) {
        const auto triangles = mesh.triangles;
        mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
    }
    expect_equal(visibilities(once), visibilities(twice), 1e-9 + same);
}

TEST(VisibilityProperties, WindingAndOrderOfVerticesChangeNothing) {
    const Stage stage = usual_stage();
    Stage mixed = stage;
    Choice choice{Random{34}};
    for (Mesh& mesh : mixed.occluders) {
        for (auto& [a, b, c] : mesh.triangles) {
            if (choice.random.next() < 0.5) std::swap(a, b);
            if (choice.random.next() < 0.5) std::swap(b, c);
        }
        mesh = test::reordered(mesh, test::shuffled_order(mesh.triangles.size(), 3));
    }
    expect_equal(visibilities(stage), visibilities(mixed), 1e-9 + same);
}

TEST(VisibilityProperties, RigidMotionsChangeNothing) {
    const Stage stage = usual_stage();
    const std::vector<double> still = visibilities(stage);
    Choice choice{Random{35}};
    for (int i = 0; i < 8; ++i) {
        const Vec3 axis = choice.direction(), shift = 3.0 * choice.vector();
        const double angle = choice.between(0, 2 * pi);
        const auto move = [&](const Vec3& p) { return turned({{p}, {}}, Vec3(0), axis, angle).positions[0] + shift; };
        expect_equal(still, visibilities(stage, move), 2e-5);  // vertices are rounded anew to float
    }
}

TEST(VisibilityProperties, ScaleChangesNothing) {
    const Stage stage = usual_stage();
    const std::vector<double> life_size = visibilities(stage);
    for (const double scale : {0x1p-10, 0x1p-3, 0x1p5, 0x1p10})
        expect_equal(life_size, visibilities(stage, [&](const Vec3& p) { return scale * p; }), 1e-9 + same);
    for (const double scale : {1e-3, 0.1, 30.0, 1e3})
        expect_equal(life_size, visibilities(stage, [&](const Vec3& p) { return scale * p; }), 2e-5);
}

TEST(VisibilityProperties, DistanceFromTheOriginChangesNothing) {
    const Stage stage = usual_stage();
    const std::vector<double> near = visibilities(stage);
    for (const double distance : {1e3, 1e4})
        expect_equal(near, visibilities(stage, [&](const Vec3& p) { return p + distance * Vec3(1, -0.5, 0.25); }),
                     2e-6);
}

TEST(VisibilityProperties, PanelsInPiecesSendTheSameLight) {
    const Stage whole = usual_stage();
    Stage pieces = whole;
    const std::vector<Vec3>& c = whole.panels[0].corners;
    const auto at = [&](double u, double v) {
        return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
    };
    pieces.panels = {{{at(0, 0), at(0.25, 0), at(0.25, 1), at(0, 1)}},
                     {{at(0.25, 0), at(1, 0), at(1, 0.5), at(0.25, 0.5)}},
                     {{at(0.25, 0.5), at(1, 0.5), at(0.25, 1)}},
                     {{at(1, 0.5), at(1, 1), at(0.25, 1)}}};
    expect_equal(visibilities(whole), visibilities(pieces), 1e-8 + same);
}

}  // namespace
}  // namespace surimi
