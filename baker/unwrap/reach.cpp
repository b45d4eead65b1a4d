// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surimi {
namespace {

using Panel = PanelPlanes::Panel;

void widen(Bounds& box, const Vec3& point) {
    box.low = glm::min(box.low, point);
    box.high = glm::max(box.high, point);
}

/// The largest of dot(direction, x) over the box.
double furthest(const Bounds& box, const Vec3& direction) {
    const Vec3 sums = glm::max(direction * box.low, direction * box.high);
    return sums.x + sums.y + sums.z;
}

/// Whether a point with these least and largest heights over a panel's plane is on a side that shines.
bool is_lit_side(const Panel& panel, double least, double largest, double tolerance) {
    return largest > tolerance || (panel.is_two_sided && least < -tolerance);
}

bool could_light(const Panel& panel, const Bounds& box, double tolerance) {
    const double height = glm::dot(panel.normal, panel.corners[0]);
    return is_lit_side(panel, -furthest(box, -panel.normal) - height, furthest(box, panel.normal) - height, tolerance);
}

bool does_light(const Panel& panel, const std::array<Vec3, 3>& triangle, const Vec3& normal, double tolerance) {
    const bool rises = std::any_of(panel.corners.begin(), panel.corners.end(), [&](const Vec3& corner) {
        return glm::dot(normal, corner - triangle[0]) > tolerance;
    });
    return rises && std::any_of(triangle.begin(), triangle.end(), [&](const Vec3& corner) {
               const double height = glm::dot(panel.normal, corner - panel.corners[0]);
               return is_lit_side(panel, height, height, tolerance);
           });
}

/// What of one monitor is left to try for a chart.
struct Candidates {
    const Bounds* box = nullptr;  ///< of the monitor
    std::vector<const Panel*> panels;
};

}  // namespace

PanelPlanes panel_planes(const Scene& scene) {
    PanelPlanes planes;
    Bounds all = bounds(scene);
    for (const Monitor& monitor : scene.monitors) {
        PanelPlanes::Group& group = planes.monitors.emplace_back();
        for (const Polygon& polygon : monitor.panels) {
            group.panels.push_back({polygon.corners, front_normal(polygon), monitor.two_sided});
            for (const Vec3& corner : polygon.corners) {
                widen(group.box, corner);
                widen(all, corner);
            }
        }
    }
    if (!(all.low.x <= all.high.x)) return planes;  // nothing to be near to
    planes.tolerance = 4 * static_cast<double>(std::numeric_limits<float>::epsilon()) * glm::length(all.high - all.low);
    return planes;
}

bool is_reached(const PanelPlanes& planes, const Surface& surface, const std::vector<uint32_t>& faces) {
    Bounds box;
    for (const uint32_t f : faces)
        for (const uint32_t v : surface.triangles[f]) widen(box, surface.positions[v]);
    std::vector<Candidates> candidates;
    for (size_t m = 0; m < planes.monitors.size(); ++m) {
        if (static_cast<int>(m) == surface.monitor) continue;
        Candidates some{&planes.monitors[m].box, {}};
        for (const Panel& panel : planes.monitors[m].panels)
            if (could_light(panel, box, planes.tolerance)) some.panels.push_back(&panel);
        if (!some.panels.empty()) candidates.push_back(std::move(some));
    }
    if (candidates.empty()) return false;
    for (const uint32_t f : faces) {
        const auto& c = surface.triangles[f];
        const std::array<Vec3, 3> triangle{surface.positions[c[0]], surface.positions[c[1]], surface.positions[c[2]]};
        const Vec3 normal = normalize_or(area_normal(triangle[0], triangle[1], triangle[2]), Vec3(0));
        const double height = glm::dot(normal, triangle[0]);
        for (const Candidates& some : candidates) {
            if (!(furthest(*some.box, normal) - height > planes.tolerance)) continue;
            for (const Panel* panel : some.panels)
                if (does_light(*panel, triangle, normal, planes.tolerance)) return true;
        }
    }
    return false;
}

}  // namespace surimi
