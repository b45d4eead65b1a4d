// SPDX-License-Identifier: Apache-2.0
// A monitor's panels in flat coordinates, and what one point sees of them.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/light/monitor.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Places are relative to RayScene::center(). A point of the panel's plane is center + s * axis_s + t * axis_t; the
/// axes are perpendicular and scaled so that the polygon lies in [-1, 1]^2.
struct Panel {
    Vec3 center{0}, axis_s{1, 0, 0}, axis_t{0, 1, 0};
    Vec3 normal{0, 0, 1};       ///< unit, front side; axis_s x axis_t points there
    std::vector<Vec2> corners;  ///< in (s, t), counter-clockwise seen from the front
    std::vector<Vec3> places;   ///< the same in space
    double rounding = 0;        ///< metres; 64 half-ulps of the largest coordinate
    double clearance = 0;       ///< metres in front of the plane within which nothing counts as an occluder

    Vec3 at(const Vec2& place) const { return center + place.x * axis_s + place.y * axis_t; }
    /// Height of a point over the plane, metres.
    double height(const Vec3& point) const { return glm::dot(normal, point - center); }
    /// False behind the plane and, to rounding, in it; that holds the lift of rays off the wall that a screen is glued
    /// to. What such points get is rounding.
    bool is_before(const Vec3& point) const { return height(point) > rounding; }
};

/// The panels of a monitor, and after each its back where the monitor is two-sided. The clearance is 1e-4 of the
/// panel's diameter and the rounding: a screen that is glued to its wall or let into it is
/// not hidden by it.
std::vector<Panel> panels_of(const Monitor& monitor, const RayScene& rays);

/// The share of the way from `origin` to any point of the panel at which it comes within the clearance; 0 when the
/// origin is closer than that or behind the panel. Rays end there.
double end_of_rays(const Panel& panel, const Vec3& origin);

/// E (M1) of the panel at unit radiance. 0 behind the panel and, to rounding, in its plane.
double unshadowed_from(const Panel& panel, const Vec3& position, const Vec3& normal);

/// A point that rays start from and the part of a panel that lights it.
struct PanelView {
    const Panel* panel = nullptr;
    Vec3 origin{0};                     ///< RayScene::ray_origin, relative to its centre
    Vec3 normal{0, 0, 1};               ///< shading normal
    Vec3 row_s{0}, row_t{0}, row_w{0};  ///< x - origin -> homogeneous (s, t, w) on the panel, w = 1 in its plane
    double end = 1;                     ///< w at which occluders cease to count (end_of_rays)
    std::vector<Vec2> lit;              ///< of the panel above the horizon of the shading normal
    std::vector<Vec2> open;             ///< of that, above the surface itself: what can arrive

    /// Does the surface itself hide nothing of what its shading normal admits?
    bool is_open() const { return open == lit; }
};

/// Fills `view`; its arrays are reused. `lit` is empty where the point is behind the panel or sees none of it.
void look_at(PanelView& view, const Panel& panel, const Vec3& origin, const Vec3& normal, const Vec3& geometric_normal);

/// Irradiance / (1/2), by (M1), of a convex polygon of the panel that lies above the view's horizon: for ratios.
double contour_integral(const PanelView& view, std::span<const Vec2> polygon);

}  // namespace surimi
