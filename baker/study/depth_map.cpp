// SPDX-License-Identifier: Apache-2.0
#include "baker/study/depth_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace surimi {
namespace {

/// Three corners of a triangle that a ray met; those of panels without a surface are counted in fans.
std::array<Vec3, 3> corners_of(const Scene& scene, const TriangleRef& where) {
    if (where.surface < scene.surfaces.size()) {
        const Surface& surface = scene.surfaces[where.surface];
        const auto& [i, j, k] = surface.triangles[where.triangle];
        return {surface.positions[i], surface.positions[j], surface.positions[k]};
    }
    size_t left = where.triangle;
    for (const Polygon& panel : scene.monitors[where.surface - scene.surfaces.size()].panels) {
        const auto& c = panel.corners;
        if (left < c.size() - 2) return {c[0], c[left + 1], c[left + 2]};
        left -= c.size() - 2;
    }
    return {};
}

}  // namespace

MonitorFrame frame_of(const Monitor& monitor, bool is_back) {
    MonitorFrame frame;
    Vec3 normal(0), longest(0);
    double sum = 0;
    for (const Polygon& panel : monitor.panels) {
        const double weight = area(panel);
        Vec3 middle(0);
        for (size_t i = 0; i < panel.corners.size(); ++i) {
            middle += panel.corners[i] / static_cast<double>(panel.corners.size());
            const Vec3 side = panel.corners[(i + 1) % panel.corners.size()] - panel.corners[i];
            if (glm::length(side) > glm::length(longest)) longest = side;
        }
        frame.center += weight * middle;
        normal += weight * front_normal(panel);
        sum += weight;
    }
    frame.center /= sum;
    frame.n = normalize_or(is_back ? -normal : normal, front_normal(monitor.panels[0]));
    frame.s = normalize_or(longest - glm::dot(longest, frame.n) * frame.n, Vec3(1, 0, 0));
    frame.t = glm::cross(frame.n, frame.s);
    for (const Polygon& panel : monitor.panels)
        for (const Vec3& corner : panel.corners)
            frame.half_size = glm::max(frame.half_size, glm::abs(Vec2(frame.local(corner))));
    return frame;
}

Vec3 DepthMap::direction(int x, int y) const {
    const double u = 2 * (x + 0.5) / size - 1, v = 2 * (y + 0.5) / size - 1;
    const Vec3 d(0.5 * (u + v), 0.5 * (u - v), 1 - std::max(std::abs(u), std::abs(v)));
    return d / d.z;
}

Vec2 DepthMap::place(const Vec3& direction) const {
    const double sum = std::abs(direction.x) + std::abs(direction.y) + direction.z;
    return 0.5 * size * (Vec2(direction.x + direction.y, direction.x - direction.y) / sum + 1.0);
}

DepthMap make_depth_map(const StudiedMonitor& light, bool is_back, int size) {
    DepthMap map;
    map.frame = frame_of(light.monitor(), is_back);
    map.size = size;
    map.depth.resize(static_cast<size_t>(size) * static_cast<size_t>(size), INFINITY);
    const double clearance = *std::max_element(light.clearance.begin(), light.clearance.end());
    const Vec3 eye = map.frame.center + clearance * map.frame.n;
    const Bounds box = bounds(light.scene);
    const double reach = glm::length(box.high - box.low);
    const Vec3& middle = light.rays.center();
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Vec3 local = map.direction(x, y);
            const Vec3 ray = glm::normalize(local.x * map.frame.s + local.y * map.frame.t + local.z * map.frame.n);
            const auto hit = light.rays.closest_occluder(eye - middle, eye + reach * ray - middle, 1, light.index);
            if (!hit) continue;
            const std::array<Vec3, 3> c = corners_of(light.scene, *hit);
            const Vec3 normal = area_normal(c[0], c[1], c[2]);
            const double distance = glm::dot(normal, c[0] - eye) / glm::dot(normal, ray);
            if (!(distance > 0) || !std::isfinite(distance)) continue;
            map.depth[static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x)] =
                static_cast<float>(clearance + distance * glm::dot(ray, map.frame.n));
        }
    }
    return map;
}

}  // namespace surimi
