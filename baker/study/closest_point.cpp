// SPDX-License-Identifier: Apache-2.0
#include "baker/study/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "baker/study/shadow_rays.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr int places = 16;  // AA_SAMPLES there

double radical_inverse(int index, int base) {
    double result = 0, digit = 1;
    for (; index > 0; index /= base) result += (digit /= base) * (index % base);
    return result;
}

Vec3 closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& point) {
    const Vec3 edge = b - a;
    const double length2 = glm::dot(edge, edge);
    return a + (length2 > 0 ? std::clamp(glm::dot(point - a, edge) / length2, 0.0, 1.0) : 0.0) * edge;
}

Vec3 closest_on_polygon(const Polygon& polygon, const Vec3& normal, const Vec3& point) {
    const std::vector<Vec3>& corners = polygon.corners;
    const Vec3 foot = point - glm::dot(point - corners[0], normal) * normal;
    bool is_inside = true;
    Vec3 best = corners[0];
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        is_inside = is_inside && glm::dot(glm::cross(b - a, foot - a), normal) >= 0;
        const Vec3 candidate = closest_on_segment(a, b, point);
        if (glm::length(candidate - point) < glm::length(best - point)) best = candidate;
    }
    return is_inside ? foot : best;
}

/// A disk around a light point, seen from a texel.
struct Disk {
    LightPoint light;
    Vec3 axis_u{0}, axis_v{0};  // perpendicular to the direction to the texel, as long as the radius

    LightPoint at(double radius, double angle) const {
        LightPoint point = light;
        point.position += radius * (std::cos(angle) * axis_u + std::sin(angle) * axis_v);
        return point;
    }
};

Disk disk_around(const LightPoint& light, const Vec3& texel, double radius) {
    const Vec3 direction = normalize_or(texel - light.position, light.normal);
    const Vec3 other = std::abs(direction.y) < 0.777 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    const Vec3 u = normalize_or(glm::cross(direction, other), Vec3(1, 0, 0));
    return {light, radius * u, radius * glm::cross(direction, u)};
}

/// Visibility of the disk from one of the texel's places.
StudyEstimate look(const Receiver& receiver, const SurfacePoint& from, const Disk& disk, int place, int count) {
    ShadowRays rays(receiver.light);
    constexpr double golden_angle = 2.4;
    const int share = count / places;
    for (int j = 0; j < share; ++j) {
        if (j == share / 2 && j > 0) {
            const double seen = rays.seen();
            if (!(seen > 0) || !(seen < rays.all())) break;
        }
        const int index = count - 1 - (place * share + j);  // the rim first
        const double turn = 2 * pi * unit_double(hash(receiver.key, static_cast<uint64_t>(index)));
        rays.add(from, disk.at(std::sqrt((index + 0.5) / count), golden_angle * index + turn), 1);
    }
    return rays.estimate();
}

}  // namespace

LightPoint closest_point_of(const Monitor& monitor, const Vec3& point) {
    LightPoint best;
    double least = INFINITY;
    for (size_t panel = 0; panel < monitor.panels.size(); ++panel) {
        const Vec3 normal = front_normal(monitor.panels[panel]);
        const Vec3 candidate = closest_on_polygon(monitor.panels[panel], normal, point);
        const double distance = glm::length(candidate - point);
        if (distance < least) best = {candidate, normal, panel}, least = distance;
    }
    return best;
}

StudyEstimate closest_point(const Receiver& receiver, int count) {
    const SurfacePoint middle = receiver.surface.sample(0.5, 0.5);
    const LightPoint light = closest_point_of(receiver.light.monitor(), middle.position);
    const bool is_disk = count > places;
    const Disk disk =
        disk_around(light, middle.position, is_disk ? std::sqrt(receiver.light.sampler.area() / pi) : 0.0);
    StudyEstimate sum;
    ShadowRays rays(receiver.light);
    for (int i = 0; i < places; ++i) {
        const SurfacePoint from = receiver.surface.sample(radical_inverse(i + 1, 2), radical_inverse(i + 1, 3));
        if (!is_disk) {
            rays.add(from, light, 1);
            continue;
        }
        const StudyEstimate seen = look(receiver, from, disk, i, count - count % places);
        sum.visibility += seen.visibility / places;
        sum.rays += seen.rays;
    }
    if (!is_disk) return rays.estimate();
    sum.is_lit = true;
    return sum;
}

}  // namespace surimi
