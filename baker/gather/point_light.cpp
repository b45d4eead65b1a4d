// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/point_light.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"

namespace surimi {
namespace {

Vec2 middle_of(std::span<const Vec2> polygon) {
    Vec2 sum(0);
    for (const Vec2& corner : polygon) sum += corner;
    return sum / static_cast<double>(polygon.size());
}

/// No silhouette on the open part of the panel: all of it or nothing.
PointVisibility by_one_ray(const MonitorSetup& setup, const PanelView& view) {
    PointVisibility result;
    result.rays = 1;
    const Vec3 target = view.panel->at(middle_of(view.open));
    if (setup.rays.is_occluded_until(view.end, view.origin, target, setup.monitor)) return result;
    result.visibility =
        view.is_open() ? 1 : std::min(1.0, contour_integral(view, view.open) / contour_integral(view, view.lit));
    return result;
}

/// More lines until the estimate is within what the error leaves.
PointVisibility by_lines(const MonitorSetup& setup, uint64_t key, const LineLimits& limits, PointWorkspace& work) {
    PointVisibility best;
    size_t rays = 0;
    for (int lines = limits.first;; lines *= 2) {
        const bool is_first = lines == limits.first;
        const ScanlineTask task{setup.rays,
                                setup.monitor,
                                lines,
                                unit_double(hash(key, 7 + static_cast<uint64_t>(lines))),
                                is_first ? 2 : 0,
                                key};
        best = scan(work.view, work.segments, task, work.scan);
        rays += best.rays;
        if (!best.is_consistent || best.error <= limits.error || lines >= most_lines) break;
        // The error falls with lines^-1.5: steps that cannot reach the limit are left out.
        while (lines < most_lines / 2 && best.error > limits.error * 5) {
            best.error /= 2.8;
            lines *= 2;
        }
    }
    best.rays = rays;
    return best;
}

/// Can the edge's shadow pass over the panel within the texel? By bounding boxes of what moving by half a texel does;
/// edges in the surface's own plane, or below it, only where they cross the texel.
bool may_sweep(const PanelView& view, const Candidates& c, size_t i, const Vec3& geometric_normal, double half_texel) {
    const Vec3 a = Vec3(c.ax[i], c.ay[i], c.az[i]) - view.origin, b = Vec3(c.bx[i], c.by[i], c.bz[i]) - view.origin;
    const double level = 1e-3 * half_texel;
    if (glm::dot(geometric_normal, a) <= level && glm::dot(geometric_normal, b) <= level)
        return distance_to_segment(Vec3(0), a, b) < 1.5 * half_texel;  // half the diagonal, and a little
    const Panel& panel = *view.panel;
    const Vec2 step = half_texel / Vec2(glm::length(panel.axis_s), glm::length(panel.axis_t));
    Vec2 low(INFINITY), high(-INFINITY);
    for (const Vec3& end : {a, b}) {
        const double w = std::max(glm::dot(view.row_w, end), 1e-4);
        const Vec2 place = Vec2(glm::dot(view.row_s, end), glm::dot(view.row_t, end)) / w;
        const Vec2 motion = step * (std::max(0.0, 1 - w) / w);
        low = glm::min(low, place - motion);
        high = glm::max(high, place + motion);
    }
    return low.x < 1 && low.y < 1 && high.x > -1 && high.y > -1;
}

struct Chosen {
    PointVisibility visibility;
    TexelMethod method = TexelMethod::none;
    bool is_dear = false;
};

Chosen choose(const MonitorSetup& setup, const PanelSight& sight, const PointTask& task, PointWorkspace& work) {
    const GatherSettings& settings = setup.settings;
    if (sight.candidates.count > 0)
        project(sight.candidates, sight.first_cut, work.view, work.segments);
    else
        work.segments.count = 0;
    const size_t count = work.segments.count;
    if (count == 0) return {by_one_ray(setup, work.view), TexelMethod::ray};
    const Tolerances& limits = setup.limits;
    const bool must_split = settings.is_exact || settings.method == Method::split;
    const LineLimits lines = lines_for(limits, task.averaged);
    const double scan_cost = cost_of_scan(count, lines.first);
    const bool is_free = settings.method == Method::automatic && !settings.is_exact;
    const double split_cost = cost_of_split(count);
    if (is_free && std::min(scan_cost, split_cost) > cost_of_monte_carlo(limits.monte_carlo))
        return {{}, TexelMethod::none, true};
    if (must_split || (is_free && split_cost <= scan_cost))
        return {split(work.view, work.segments, setup.rays, setup.monitor, work.split), TexelMethod::split};
    return {by_lines(setup, task.key, lines, work), TexelMethod::scanline};
}

}  // namespace

PointLight light_at(const MonitorSetup& setup, const BlockSight& sight, const SurfacePoint& point,
                    const PointTask& task, PointWorkspace& work) {
    PointLight light;
    const Vec3 position = point.position - setup.rays.center();
    const Vec3 origin = setup.rays.ray_origin(point) - setup.rays.center();
    for (size_t i = 0; i < sight.count && !light.is_dear; ++i) {
        const PanelSight& panel_sight = sight.panels[i];
        const Panel& panel = *panel_sight.panel;
        const double unshadowed = unshadowed_from(panel, position, point.normal);
        if (!(unshadowed > 0)) continue;
        light.unshadowed += unshadowed;
        light.method = std::max(light.method, TexelMethod::certificate);
        if (panel_sight.is_hidden) continue;
        look_at(work.view, panel, origin, point.normal, point.geometric_normal);
        if (work.view.open.empty()) {
            light.is_self_hidden = light.is_self_hidden || !work.view.lit.empty();
            continue;
        }
        light.has_near = light.has_near || std::ranges::any_of(panel_sight.near, [&](size_t edge) {
                             return may_sweep(work.view, panel_sight.candidates, edge, point.geometric_normal,
                                              0.5 * sight.texel_size);
                         });
        const Chosen chosen = choose(setup, panel_sight, {hash(task.key, i), task.averaged}, work);
        light.method = std::max(light.method, chosen.method);
        light.is_dear = chosen.is_dear;
        light.has_failed = light.has_failed || !chosen.visibility.is_consistent;
        light.shadowed += unshadowed * chosen.visibility.visibility;
        light.error += unshadowed * chosen.visibility.error;
        light.rays += chosen.visibility.rays;
        light.segments += work.segments.count;
    }
    if (light.unshadowed > 0) light.error /= light.unshadowed;
    light.unshadowed = std::min(light.unshadowed, pi);
    light.shadowed = std::clamp(light.shadowed, 0.0, light.unshadowed);
    return light;
}

}  // namespace surimi
