// SPDX-License-Identifier: Apache-2.0
#include "tests/support/closed_form.h"

#include <algorithm>
#include <cmath>

#include "runtime/ltc/polygon.h"

namespace surimi::test {
namespace {

double cross2(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(),
              [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<Vec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const size_t floor = hull.size() + 2;
        for (const Vec2& p : points) {
            while (hull.size() >= floor && cross2(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

std::vector<Vec2> intersection(std::vector<Vec2> polygon, const std::vector<Vec2>& convex) {
    for (size_t e = 0; e < convex.size() && !polygon.empty(); ++e) {
        const Vec2 &p = convex[e], &q = convex[(e + 1) % convex.size()];
        std::vector<Vec2> kept;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double da = cross2(q - p, a - p), db = cross2(q - p, b - p);
            if (da >= 0) kept.push_back(a);
            if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (b - a) * (da / (da - db)));
        }
        polygon.swap(kept);
    }
    return polygon;
}

}  // namespace

double corner_form_factor(double w, double l, double h) {
    const double a = w / h, b = l / h;
    const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
    return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * pi);
}

double irradiance_by_quadrature(const Polygon& light, const Vec3& point, const Vec3& normal, int n) {
    const Vec3 u = light.corners[1] - light.corners[0], v = light.corners[3] - light.corners[0];
    const Vec3 front = glm::cross(u, v);  // length: the area
    double sum = 0;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const Vec3 d = light.corners[0] + (x + 0.5) / n * u + (y + 0.5) / n * v - point;
            const double r2 = glm::dot(d, d);
            const double receiver = glm::dot(d, normal), emitter = -glm::dot(d, front);
            if (receiver > 0 && emitter > 0) sum += receiver * emitter / (r2 * r2);
        }
    }
    return sum / (static_cast<double>(n) * n);
}

double exact_visibility(const Polygon& light, const Vec3& point, const Vec3& normal,
                        std::span<const Occluder> occluders) {
    const Vec3 origin = light.corners[0];
    const Vec3 u = glm::normalize(light.corners[1] - origin);
    const Vec3 n = glm::normalize(glm::cross(light.corners[1] - origin, light.corners[2] - origin));
    const Vec3 v = glm::cross(n, u);
    const auto flat = [&](const Vec3& p) { return Vec2(glm::dot(p - origin, u), glm::dot(p - origin, v)); };
    std::vector<Vec2> outline;
    for (const Vec3& corner : light.corners) outline.push_back(flat(corner));

    const double whole = irradiance_of_polygon<double>(light.corners, point, normal);
    double hidden = 0;
    for (const Occluder& occluder : occluders) {
        std::vector<Vec2> projected;
        for (const Vec3& p : occluder.points) {
            const double t = glm::dot(origin - point, n) / glm::dot(p - point, n);
            projected.push_back(flat(point + t * (p - point)));
        }
        std::vector<Vec3> shadow;
        for (const Vec2& p : intersection(outline, convex_hull(projected)))
            shadow.push_back(origin + p.x * u + p.y * v);
        if (shadow.size() >= 3) hidden += irradiance_of_polygon<double>(shadow, point, normal);
    }
    return 1 - hidden / whole;
}

}  // namespace surimi::test
