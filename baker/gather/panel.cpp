// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/panel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "baker/texel/polygon.h"
#include "runtime/ltc/polygon.h"

namespace surimi {
namespace {

Panel make_panel(const Polygon& polygon, const Vec3& scene_center) {
    Panel panel;
    panel.normal = front_normal(polygon);
    Vec3 longest(0);
    double magnitude = 0;
    for (size_t i = 0; i < polygon.corners.size(); ++i) {
        const Vec3 place = polygon.corners[i] - scene_center;
        panel.places.push_back(place);
        panel.center += place / static_cast<double>(polygon.corners.size());
        magnitude = std::max(magnitude, largest_component(place));
        const Vec3 side = polygon.corners[(i + 1) % polygon.corners.size()] - polygon.corners[i];
        if (glm::dot(side, side) > glm::dot(longest, longest)) longest = side;
    }
    const Vec3 s = normalize_or(longest - glm::dot(longest, panel.normal) * panel.normal, {1, 0, 0});
    const Vec3 t = glm::cross(panel.normal, s);
    double extent_s = 0, extent_t = 0, diameter = 0;
    for (const Vec3& place : panel.places) {
        extent_s = std::max(extent_s, std::abs(glm::dot(s, place - panel.center)));
        extent_t = std::max(extent_t, std::abs(glm::dot(t, place - panel.center)));
        for (const Vec3& other : panel.places) diameter = std::max(diameter, glm::length(other - place));
    }
    panel.axis_s = s * extent_s;
    panel.axis_t = t * extent_t;
    for (const Vec3& place : panel.places)
        panel.corners.emplace_back(glm::dot(s, place - panel.center) / extent_s,
                                   glm::dot(t, place - panel.center) / extent_t);
    constexpr double half_ulp = 0.5 * std::numeric_limits<float>::epsilon();
    panel.rounding = 64 * half_ulp * magnitude;
    panel.clearance = 1e-4 * diameter + panel.rounding;
    return panel;
}

Panel reversed(const Panel& front) {
    Panel back = front;
    back.normal = -front.normal;
    back.axis_t = -front.axis_t;
    std::ranges::reverse(back.corners);
    std::ranges::reverse(back.places);
    for (Vec2& corner : back.corners) corner.y = -corner.y;
    return back;
}

/// The panel's points above a horizon: x * s + y * t + z >= 0.
Vec3 horizon_line(const Panel& panel, const Vec3& origin, const Vec3& normal) {
    return {glm::dot(normal, panel.axis_s), glm::dot(normal, panel.axis_t), glm::dot(normal, panel.center - origin)};
}

}  // namespace

std::vector<Panel> panels_of(const Monitor& monitor, const RayScene& rays) {
    std::vector<Panel> panels;
    for (const Polygon& polygon : monitor.panels) {
        panels.push_back(make_panel(polygon, rays.center()));
        if (monitor.two_sided) panels.push_back(reversed(panels.back()));
    }
    return panels;
}

double end_of_rays(const Panel& panel, const Vec3& origin) {
    const double height = panel.height(origin);
    return height > panel.clearance ? 1 - panel.clearance / height : 0;
}

double unshadowed_from(const Panel& panel, const Vec3& position, const Vec3& normal) {
    if (!panel.is_before(position)) return 0;
    return irradiance_of_polygon<double>(panel.places, position, normal);
}

void look_at(PanelView& view, const Panel& panel, const Vec3& origin, const Vec3& normal,
             const Vec3& geometric_normal) {
    view.panel = &panel;
    view.origin = origin;
    view.normal = normal;
    view.lit.clear();
    view.open.clear();
    const double height = panel.height(origin);
    if (!(height > 0)) return;
    // x - origin = a axis_s + b axis_t + w (center - origin): w from the panel's normal, a and b from what is left.
    const Vec3 to_center = panel.center - origin;
    view.row_w = -panel.normal / height;
    const Vec3 s = panel.axis_s / glm::dot(panel.axis_s, panel.axis_s);
    const Vec3 t = panel.axis_t / glm::dot(panel.axis_t, panel.axis_t);
    view.row_s = s - glm::dot(s, to_center) * view.row_w;
    view.row_t = t - glm::dot(t, to_center) * view.row_w;
    view.end = end_of_rays(panel, origin);
    cut(panel.corners, horizon_line(panel, origin, normal), view.lit);
    if (!view.lit.empty()) cut(view.lit, horizon_line(panel, origin, geometric_normal), view.open);
}

double contour_integral(const PanelView& view, std::span<const Vec2> polygon) {
    if (polygon.size() < 3) return 0;
    double sum = 0;
    Vec3 a = view.panel->at(polygon.back()) - view.origin;
    for (const Vec2& corner : polygon) {
        const Vec3 b = view.panel->at(corner) - view.origin;
        sum += edge_integral(a, b, view.normal);
        a = b;
    }
    return std::abs(sum);
}

}  // namespace surimi
