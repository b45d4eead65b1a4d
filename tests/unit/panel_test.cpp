// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/panel.h"
#include "baker/texel/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/ltc/polygon.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A tilted pentagon some way off the scene's centre.
struct Stage {
    Scene scene;
    Polygon pentagon;

    explicit Stage(bool is_two_sided = false, double away = 3) {
        test::add_box(scene, "Room", Vec3(away, 0, 0), Vec3(8), true);
        test::add_quad(scene, "Origin", {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0});
        const Vec3 u = glm::normalize(Vec3(1, 0.2, -0.3)), v = glm::normalize(glm::cross(u, Vec3(0.4, -1, 0.5)));
        for (const Vec2& c : {Vec2(-1, -0.4), Vec2(0.9, -0.5), Vec2(1.2, 0.2), Vec2(0.1, 0.7), Vec2(-0.8, 0.3)})
            pentagon.corners.push_back(Vec3(away, 2, 0.5) + c.x * u + c.y * v);
        Monitor monitor;
        monitor.name = "Pentagon";
        monitor.two_sided = is_two_sided;
        monitor.panels = {pentagon};
        scene.monitors.push_back(monitor);
    }
};

double doubled_area(const std::vector<Vec2>& polygon) {
    double sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

TEST(Panel, FrameIsPerpendicularAndHoldsThePolygonInTheUnitSquare) {
    const Stage stage(true);
    const RayScene rays(stage.scene);
    const auto panels = panels_of(stage.scene.monitors[0], rays);
    ASSERT_EQ(panels.size(), 2u) << "front and back";
    for (const Panel& panel : panels) {
        EXPECT_NEAR(glm::dot(panel.axis_s, panel.axis_t), 0, 1e-15);
        const Vec3 normal = glm::normalize(glm::cross(panel.axis_s, panel.axis_t));
        EXPECT_NEAR(glm::dot(normal, panel.normal), 1, 1e-15);
        EXPECT_GT(doubled_area(panel.corners), 0) << "counter-clockwise from its front";
        ASSERT_EQ(panel.corners.size(), 5u);
        double largest_s = 0, largest_t = 0;
        for (size_t i = 0; i < 5; ++i) {
            EXPECT_LT(glm::length(panel.at(panel.corners[i]) - panel.places[i]), 1e-14);
            largest_s = std::max(largest_s, std::abs(panel.corners[i].x));
            largest_t = std::max(largest_t, std::abs(panel.corners[i].y));
        }
        EXPECT_NEAR(largest_s, 1, 1e-14);
        EXPECT_NEAR(largest_t, 1, 1e-14);
    }
    EXPECT_LT(glm::length(panels[0].normal + panels[1].normal), 1e-15);
    EXPECT_GT(glm::dot(panels[0].normal, front_normal(stage.pentagon)), 1 - 1e-12);
    EXPECT_EQ(panels_of(Stage().scene.monitors[0], rays).size(), 1u) << "one side";
}

TEST(Panel, ClearanceGrowsWithThePanelAndWithTheRoundingOfFarPlaces) {
    const Stage near, far(false, 3000);
    const RayScene rays(near.scene), far_rays(far.scene);
    const double close = panels_of(near.scene.monitors[0], rays)[0].clearance;
    const double diameter = glm::length(near.pentagon.corners[0] - near.pentagon.corners[2]);
    EXPECT_GT(close, 1e-4 * diameter);
    EXPECT_LT(close, 1.2e-4 * diameter);
    EXPECT_GT(panels_of(far.scene.monitors[0], far_rays)[0].clearance, 64 * 0x1p-24 * 1000);
}

TEST(Panel, RaysEndAtTheClearance) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Panel panel = panels_of(stage.scene.monitors[0], rays)[0];
    const Vec3 origin = panel.center + 2.0 * panel.normal + 0.3 * panel.axis_s;
    const double end = end_of_rays(panel, origin);
    for (const Vec2& q : panel.corners)
        EXPECT_NEAR(panel.height(origin + end * (panel.at(q) - origin)), panel.clearance, 1e-14);
    EXPECT_EQ(end_of_rays(panel, panel.center + 0.5 * panel.clearance * panel.normal), 0);
    EXPECT_EQ(end_of_rays(panel, panel.center), 0);
    EXPECT_EQ(end_of_rays(panel, panel.center - 2.0 * panel.normal), 0);
}

TEST(Panel, CutKeepsThePartOnTheLinesSide) {
    const std::vector<Vec2> square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    std::vector<Vec2> part;
    cut(square, {1, 0, 0.5}, part);  // x >= -1/2
    EXPECT_NEAR(doubled_area(part), 6, 1e-15);
    for (const Vec2& p : part) EXPECT_GE(p.x, -0.5);
    cut(square, {1, 1, 0}, part);  // along a diagonal, through two corners
    EXPECT_EQ(part.size(), 3u);
    EXPECT_NEAR(doubled_area(part), 4, 1e-15);
    cut(square, {0, 1, 2}, part);
    EXPECT_EQ(part, square);
    cut(square, {0, 1, -2}, part);
    EXPECT_TRUE(part.empty());
    cut(square, {0, 1, -1}, part);  // one side of it lies on the line: no area
    EXPECT_TRUE(part.empty());
}

TEST(PanelView, RowsGivePlacesOnThePanelAndTheShareOfTheWay) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Panel panel = panels_of(stage.scene.monitors[0], rays)[0];
    PanelView view;
    Choice choice{Random{1}};
    for (int i = 0; i < 100; ++i) {
        const Vec3 origin = panel.center + choice.between(0.01, 4) * panel.normal + 2.0 * choice.vector();
        if (panel.height(origin) < 0.01) continue;
        look_at(view, panel, origin, -panel.normal, -panel.normal);
        const Vec2 q(choice.between(-1, 1), choice.between(-1, 1));
        const double way = choice.between(0.05, 1);
        const Vec3 x = way * (panel.at(q) - origin);
        const double w = glm::dot(view.row_w, x);
        EXPECT_NEAR(w, way, 1e-12);
        EXPECT_NEAR(glm::dot(view.row_s, x) / w, q.x, 1e-9);
        EXPECT_NEAR(glm::dot(view.row_t, x) / w, q.y, 1e-9);
        EXPECT_EQ(view.lit, panel.corners);
        EXPECT_EQ(view.open, panel.corners);
    }
}

TEST(PanelView, IsCutByBothHorizons_M4) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Panel panel = panels_of(stage.scene.monitors[0], rays)[0];
    PanelView view;
    Choice choice{Random{2}};
    int cut_by_one = 0, cut_by_two = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 origin = panel.center + choice.between(0.1, 2) * panel.normal + choice.vector();
        const Vec3 normal = choice.direction();
        const Vec3 geometric_normal = normalize_or(normal + choice.vector(), normal);
        look_at(view, panel, origin, normal, geometric_normal);
        if (panel.height(origin) <= 0) {
            EXPECT_TRUE(view.lit.empty());
            continue;
        }
        const double e = irradiance_of_polygon<double>(panel.places, origin, normal);
        EXPECT_NEAR(0.5 * contour_integral(view, view.lit), e, 1e-13);
        for (const Vec2& q : view.open) {
            EXPECT_GE(glm::dot(normal, panel.at(q) - origin), -1e-12);
            EXPECT_GE(glm::dot(geometric_normal, panel.at(q) - origin), -1e-12);
        }
        EXPECT_LE(contour_integral(view, view.open), contour_integral(view, view.lit) + 1e-13);
        const bool is_cut = !view.lit.empty() && view.lit != panel.corners;
        cut_by_one += is_cut;
        cut_by_two += is_cut && !view.open.empty() && view.open != view.lit;
    }
    EXPECT_GT(cut_by_one, 100);
    EXPECT_GT(cut_by_two, 20);
}

TEST(PanelView, SeesNothingFromBehindOrFromThePanelsPlane) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Panel panel = panels_of(stage.scene.monitors[0], rays)[0];
    PanelView view;
    look_at(view, panel, panel.center + panel.normal, -panel.normal, -panel.normal);
    EXPECT_FALSE(view.open.empty());
    for (const double height : {0.0, -1e-6, -1.0}) {
        look_at(view, panel, panel.center + 3.0 * panel.axis_s + height * panel.normal, -panel.normal, -panel.normal);
        // In the plane itself rounding decides, but what is seen there is nothing.
        EXPECT_NEAR(contour_integral(view, view.lit), 0, 1e-12) << height;
    }
}

}  // namespace
}  // namespace surimi
