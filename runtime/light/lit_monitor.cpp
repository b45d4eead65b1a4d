// SPDX-License-Identifier: Apache-2.0
#include "runtime/light/lit_monitor.h"

namespace surimi {

std::vector<MonitorHit> hits_of(const Monitor& monitor, const Vec3& origin, const Vec3& direction) {
    std::vector<MonitorHit> hits;
    for (size_t panel = 0; panel < monitor.panels.size(); ++panel) {
        const std::vector<Vec3>& corners = monitor.panels[panel].corners;
        // The ray passes a convex polygon where it runs on one side of all its edges.
        bool is_left_of_all = true, is_right_of_all = true;
        for (size_t i = 0; i < corners.size(); ++i) {
            const Vec3 a = corners[i] - origin, b = corners[(i + 1) % corners.size()] - origin;
            const double side = glm::dot(direction, glm::cross(a, b));
            is_left_of_all = is_left_of_all && side >= 0;
            is_right_of_all = is_right_of_all && side <= 0;
        }
        if (is_left_of_all == is_right_of_all) continue;  // beside it, or edge-on
        const Vec3 normal = front_normal(monitor.panels[panel]);
        const double slope = glm::dot(direction, normal);
        const double distance = glm::dot(corners[0] - origin, normal) / slope;
        if (distance > 0 && std::isfinite(distance)) hits.push_back({distance, panel, slope < 0});
    }
    return hits;
}

}  // namespace surimi
