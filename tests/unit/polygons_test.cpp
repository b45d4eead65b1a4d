// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/polygons.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surimi {
namespace {

Triangle triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {a, b, c};
}

/// A grid of n x n cells over the unit square, cut along alternating diagonals.
std::vector<Triangle> grid(int n) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < n * n; ++i) {
        const auto at = [&](int x, int y) {
            return Vec3(static_cast<double>(i % n + x) / n, static_cast<double>(i / n + y) / n, 0);
        };
        const bool is_odd = (i % n + i / n) % 2 == 1;
        triangles.push_back(is_odd ? triangle(at(0, 0), at(1, 0), at(0, 1)) : triangle(at(0, 0), at(1, 0), at(1, 1)));
        triangles.push_back(is_odd ? triangle(at(1, 0), at(1, 1), at(0, 1)) : triangle(at(0, 0), at(1, 1), at(0, 1)));
    }
    return triangles;
}

double total_area(const std::vector<Polygon>& polygons) {
    double sum = 0;
    for (const Polygon& p : polygons) sum += area(p);
    return sum;
}

TEST(MakePolygons, AFinelyCutRectangleIsOnePolygon) {
    const std::vector<Polygon> polygons = make_polygons(grid(7));
    ASSERT_EQ(polygons.size(), 1u);
    EXPECT_EQ(polygons[0].corners.size(), 4u);
    EXPECT_TRUE(is_rectangle(polygons[0]));
    EXPECT_NEAR(area(polygons[0]), 1, 1e-12);
    EXPECT_EQ(front_normal(polygons[0]), Vec3(0, 0, 1));
}

TEST(MakePolygons, SharedCornersMayBeRounded) {
    std::vector<Triangle> triangles = grid(4);
    for (size_t t = 0; t < triangles.size(); ++t)
        for (Vec3& p : triangles[t]) p = Vec3(Vec3f(p * 1.7 + Vec3(10.1, -3.3, 7.7)));  // as a file would store it
    EXPECT_EQ(make_polygons(triangles).size(), 1u);
}

TEST(MakePolygons, HolesAndDentsKeepTheirArea) {
    std::vector<Triangle> with_hole = grid(3);
    with_hole.erase(with_hole.begin() + 8, with_hole.begin() + 10);  // the middle cell
    EXPECT_NEAR(total_area(make_polygons(with_hole)), 8.0 / 9, 1e-12);
    EXPECT_EQ(make_polygons(with_hole).size(), with_hole.size());
    std::vector<Triangle> with_dent = grid(3);
    with_dent.erase(with_dent.begin() + 2, with_dent.begin() + 4);
    EXPECT_NEAR(total_area(make_polygons(with_dent)), 8.0 / 9, 1e-12);
}

TEST(MakePolygons, ACurvedWallIsOnePolygonForEachPanel) {
    std::vector<Triangle> wall;
    constexpr int panels = 24;
    const auto at = [](int i, double y) { return Vec3(5 * std::sin(0.05 * i), y, -5 * std::cos(0.05 * i)); };
    for (int i = 0; i < panels; ++i) {
        wall.push_back(triangle(at(i, 0), at(i + 1, 0), at(i + 1, 2)));
        wall.push_back(triangle(at(i, 0), at(i + 1, 2), at(i, 2)));
    }
    const std::vector<Polygon> polygons = make_polygons(wall);
    EXPECT_EQ(polygons.size(), static_cast<size_t>(panels));
    EXPECT_NEAR(total_area(polygons), panels * 2 * 10 * std::sin(0.025), 1e-9);
}

TEST(MakePolygons, TwoSidesAreTwoPolygons) {
    std::vector<Triangle> both = grid(2);
    for (const Triangle& t : grid(2)) both.push_back({t[0], t[2], t[1]});
    const std::vector<Polygon> polygons = make_polygons(both);
    ASSERT_EQ(polygons.size(), 2u);
    EXPECT_NEAR(glm::dot(front_normal(polygons[0]), front_normal(polygons[1])), -1, 1e-12);
    EXPECT_FALSE(one_polygon(both));
}

TEST(MakePolygons, TrianglesWithoutAreaAreDropped) {
    std::vector<Triangle> triangles = grid(1);
    triangles.push_back(triangle(Vec3(0), Vec3(1, 0, 0), Vec3(2, 0, 0)));
    EXPECT_EQ(make_polygons(triangles).size(), 1u);
    EXPECT_TRUE(make_polygons({triangles.back()}).empty());
    EXPECT_TRUE(make_polygons({}).empty());
}

TEST(MakePolygons, TrapezoidsAreNoRectangles) {
    EXPECT_FALSE(is_rectangle({{Vec3(0), Vec3(2, 0, 0), Vec3(1.5, 1, 0), Vec3(0.5, 1, 0)}}));
    EXPECT_FALSE(is_rectangle({{Vec3(0), Vec3(2, 0, 0), Vec3(1.5, 1, 0)}}));
}

TEST(PolygonArea, FarFromTheOriginKeepsItsDigits) {
    const Vec3 far(1e6, 1e6, 1e6);
    const Polygon polygon{{far, far + Vec3(1, 0, 0), far + Vec3(1, 1, 0), far + Vec3(0, 1, 0)}};
    EXPECT_NEAR(area(polygon), 1, 1e-9);
    EXPECT_NEAR(glm::length(front_normal(polygon) - Vec3(0, 0, 1)), 0, 1e-9);
}

}  // namespace
}  // namespace surimi
