// SPDX-License-Identifier: Apache-2.0
#include "baker/study/solid_angle.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

/// Of the triangle of three directions that need not be unit (Van Oosterom and Strackee 1983).
double solid_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    const double sum = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2 * std::atan2(volume, sum);
}

/// `v` without its part along the unit vector `axis`, unit.
Vec3 perpendicular(const Vec3& v, const Vec3& axis) {
    return normalize_or(v - glm::dot(v, axis) * axis, axis);
}

/// A direction in the spherical triangle of unit vectors, even by solid angle: the first number moves C along AC until
/// the triangle A, B, C' has that share of the whole, the second goes from B to C' (Arvo 1995).
Vec3 arvo(const Vec3& a, const Vec3& b, const Vec3& c, double solid_angle, const Vec2& numbers) {
    const Vec3 ab = glm::cross(a, b), ac = glm::cross(a, c);
    const double angle = std::atan2(glm::length(glm::cross(ab, ac)), glm::dot(ab, ac));  // at A
    const double s = std::sin(numbers.x * solid_angle - angle), t = std::cos(numbers.x * solid_angle - angle);
    const double u = t - std::cos(angle), v = s + std::sin(angle) * glm::dot(a, b);
    const double divisor = (v * s + u * t) * std::sin(angle);
    const double q = divisor != 0 ? std::clamp(((v * t - u * s) * std::cos(angle) - v) / divisor, -1.0, 1.0) : 1;
    const Vec3 moved = q * a + std::sqrt(1 - q * q) * perpendicular(c, a);
    const double z = 1 - numbers.y * (1 - glm::dot(moved, b));
    return z * b + std::sqrt(std::max(0.0, 1 - z * z)) * perpendicular(moved, b);
}

}  // namespace

SeenMonitor::SeenMonitor(const Monitor& monitor, const Vec3& from) : from_(from) {
    for (size_t panel = 0; panel < monitor.panels.size(); ++panel) {
        const std::vector<Vec3>& corners = monitor.panels[panel].corners;
        const Vec3 normal = front_normal(monitor.panels[panel]);
        const double height = glm::dot(normal, from - corners[0]);
        if (!(height > 0) && !(monitor.two_sided && height < 0)) continue;
        for (size_t i = 1; i + 1 < corners.size(); ++i) {
            Triangle triangle{0, 0, corners[0] - from, corners[i] - from, corners[i + 1] - from, normal, panel};
            triangle.solid_angle = solid_angle_of(triangle.a, triangle.b, triangle.c);
            if (!(triangle.solid_angle > 0)) continue;
            triangle.cumulative = sum_ += triangle.solid_angle;
            triangles_.push_back(triangle);
        }
    }
}

LightPoint SeenMonitor::sample(double u, double v, double& weight) const {
    const double target = u * sum_;
    size_t i = 0;
    while (i + 1 < triangles_.size() && target >= triangles_[i].cumulative) ++i;
    const Triangle& t = triangles_[i];
    // The number that chooses the triangle is stretched to serve again within it: strata survive.
    const Vec2 numbers(std::clamp((target - t.cumulative) / t.solid_angle + 1, 0.0, 1.0), v);
    weight = sum_;
    constexpr double smallest =
        1e-6;  // below it rounding moves directions; a panel that far off is even by area anyway
    if (t.solid_angle >= smallest) {
        const Vec3 way = arvo(glm::normalize(t.a), glm::normalize(t.b), glm::normalize(t.c), t.solid_angle, numbers);
        const double distance = glm::dot(t.normal, t.a) / glm::dot(t.normal, way);
        if (std::isfinite(distance) && distance > 0) return {from_ + distance * way, t.normal, t.panel};
    }
    const double root = std::sqrt(numbers.x);
    const Vec3 place = t.a + root * (t.b - t.a) + numbers.y * root * (t.c - t.b);
    return {from_ + place, t.normal, t.panel};
}

}  // namespace surimi
