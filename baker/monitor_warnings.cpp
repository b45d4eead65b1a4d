// SPDX-License-Identifier: Apache-2.0
#include "baker/monitor_warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/light/sample.h"

namespace surimi {
namespace {

/// Metres of free way in front of a monitor: the median over a grid of points.
double free_distance(const RayScene& rays, const Monitor& monitor, double step_off) {
    const MonitorSampler sampler(monitor);
    std::vector<double> distances;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
            const LightPoint p = sampler.sample((x + 0.5) / 3, (y + 0.5) / 3);
            const auto hit = rays.closest_hit(p.position + step_off * p.normal, p.normal);
            distances.push_back(hit ? hit->distance : INFINITY);
        }
    }
    std::nth_element(distances.begin(), distances.begin() + 4, distances.end());
    return distances[4];
}

/// Shorter side of the monitor's box, about its height.
double height(const Monitor& monitor) {
    Vec3 low(INFINITY), high(-INFINITY);
    for (const Polygon& panel : monitor.panels)
        for (const Vec3& corner : panel.corners) low = glm::min(low, corner), high = glm::max(high, corner);
    const double diagonal2 = glm::dot(high - low, high - low), a = area(monitor);
    // Sides of the rectangle with this diagonal and area: (s + l)^2 = d^2 + 2 a, (l - s)^2 = d^2 - 2 a.
    return 0.5 * (std::sqrt(diagonal2 + 2 * a) - std::sqrt(std::max(0.0, diagonal2 - 2 * a)));
}

std::string direction_name(const Vec3& d) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(d[i]) > std::abs(d[axis])) axis = i;
    return fmt::format("{}{}", d[axis] < 0 ? '-' : '+', "XYZ"[axis]);
}

}  // namespace

std::vector<std::string> monitor_warnings(const Scene& scene, const RayScene& rays) {
    std::vector<std::string> warnings;
    for (const Monitor& monitor : scene.monitors) {
        const double tall = height(monitor);
        const double distance = free_distance(rays, monitor, 1e-4 * tall);
        if (distance < tall && !monitor.two_sided)
            warnings.push_back(
                fmt::format("monitor {} shines towards {} into a surface {:.2g} m away, closer than its own height "
                            "({:.2g} m); if it "
                            "faces the wrong way, flip its normals",
                            monitor.name, direction_name(front_normal(monitor.panels.front())), distance, tall));
    }
    return warnings;
}

}  // namespace surimi
