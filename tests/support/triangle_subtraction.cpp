// SPDX-License-Identifier: Apache-2.0
#include "tests/support/triangle_subtraction.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "runtime/scene/texture.h"
#include "tests/support/quadrature.h"

namespace surimi::test {
namespace {

using Fragment = std::vector<Vec2>;

/// x * p.x + y * p.y + z >= 0.
double side_of(const Vec3& line, const Vec2& p) {
    return line.x * p.x + line.y * p.y + line.z;
}

/// A panel's plane as its points are seen from an origin: origin + at(p), p in metres along two unit axes.
struct Sight {
    Vec3 corner{0}, u{1, 0, 0}, v{0, 1, 0};
    Vec3 at(const Vec2& p) const { return corner + p.x * u + p.y * v; }
    /// Where n.q >= offset for the points q = at(p).
    Vec3 line(const Vec3& n, double offset) const {
        return {glm::dot(n, u), glm::dot(n, v), glm::dot(n, corner) - offset};
    }
};

Fragment part(const Fragment& polygon, const Vec3& line, double sign) {
    Fragment kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = sign * side_of(line, a), db = sign * side_of(line, b);
        if (da >= 0) kept.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    return kept;
}

double area(const Fragment& polygon) {
    double twice = 0;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Vec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(twice);
}

/// A convex set as the intersection of half-planes.
using HalfPlanes = std::array<Vec3, 4>;

/// What a triangle, given relative to the origin, hides. False where it hides nothing of `whole`.
bool find_shadow(const std::array<Vec3, 3>& t, const Sight& sight, double end, const Fragment& whole,
                 HalfPlanes& shadow) {
    const Vec3 facing = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double volume = glm::dot(t[0], facing);
    if (volume == 0) return false;  // seen edge-on
    const double sign = volume > 0 ? 1 : -1;
    for (size_t k = 0; k < 3; ++k) shadow[k] = sight.line(sign * glm::cross(t[(k + 1) % 3], t[(k + 2) % 3]), 0);
    shadow[3] = sight.line(sign * facing, std::abs(volume) / end);
    return std::all_of(shadow.begin(), shadow.end(), [&](const Vec3& line) {
        return std::any_of(whole.begin(), whole.end(), [&](const Vec2& p) { return side_of(line, p) > 0; });
    });
}

void subtract(std::vector<Fragment>& fragments, const HalfPlanes& shadow, double least_area) {
    std::vector<Fragment> left;
    for (Fragment& fragment : fragments) {
        const size_t before = left.size();
        Fragment inside = fragment;
        for (const Vec3& line : shadow) {
            Fragment outside = part(inside, line, -1);
            inside = part(inside, line, 1);
            if (area(outside) > least_area) left.push_back(std::move(outside));
            if (inside.size() < 3) break;
        }
        if (area(inside) > least_area) continue;
        left.resize(before);  // they do not meet: it stays in one piece
        left.push_back(std::move(fragment));
    }
    fragments.swap(left);
}

double irradiance(const std::vector<Fragment>& fragments, const Sight& sight, const Vec3& normal) {
    Real sum = 0;
    for (const Fragment& fragment : fragments) {
        std::vector<Vec3l> corners;
        for (const Vec2& p : fragment)
            corners.push_back(Vec3l(sight.corner) + Real(p.x) * Vec3l(sight.u) + Real(p.y) * Vec3l(sight.v));
        sum += corner_irradiance(corners, Vec3l(normal));
    }
    return static_cast<double>(sum);
}

/// A panel as seen from an origin, and the part of it above the horizon; none from behind.
struct LitPanel {
    Sight sight;
    Fragment lit;
    double height = 0, least_area = 0;
};

LitPanel look_at(const Obstructed& scene, const Obstructed::Panel& panel, const Vec3& origin, const Vec3& normal) {
    LitPanel result;
    const double front = glm::dot(panel.normal, origin - panel.center);
    result.height = scene.is_two_sided ? std::abs(front) : front;
    if (!(result.height > 0)) return result;
    Sight& sight = result.sight;
    sight.corner = panel.center - origin;
    sight.u = panel.corners[1] - panel.corners[0];
    sight.u = normalize_or(sight.u - glm::dot(sight.u, panel.normal) * panel.normal, {1, 0, 0});
    sight.v = glm::cross(panel.normal, sight.u);
    Fragment whole;
    for (const Vec3& corner : panel.corners)
        whole.emplace_back(glm::dot(sight.u, corner - panel.center), glm::dot(sight.v, corner - panel.center));
    result.least_area = 1e-16 * area(whole);
    result.lit = part(whole, sight.line(normal, 0), 1);
    return result;
}

SubtractedIrradiance of_panel(const Obstructed& scene, const Obstructed::Panel& panel, const Vec3& origin,
                              const Vec3& normal, const Vec3& geometric_normal) {
    const LitPanel seen = look_at(scene, panel, origin, normal);
    SubtractedIrradiance result;
    result.unshadowed = irradiance({seen.lit}, seen.sight, normal);
    const Fragment open = part(seen.lit, seen.sight.line(geometric_normal, 0), 1);
    if (open.size() < 3) return result;
    std::vector<Fragment> fragments{open};
    const double end = 1 - panel.clearance / seen.height;
    for (const auto& t : scene.triangles) {
        if (!(end > 0) || fragments.empty()) break;
        HalfPlanes shadow;
        if (find_shadow({t[0] - origin, t[1] - origin, t[2] - origin}, seen.sight, end, open, shadow))
            subtract(fragments, shadow, seen.least_area);
    }
    result.shadowed = irradiance(fragments, seen.sight, normal);
    return result;
}

}  // namespace

Obstructed obstructed(const Scene& scene, const RayScene& rays, size_t monitor) {
    Obstructed result;
    result.center = rays.center();
    const auto seen = [&](const Vec3& p) { return Vec3(Vec3f(p - result.center)); };
    std::vector<bool> has_surface(scene.monitors.size(), false);
    for (const Surface& surface : scene.surfaces) {
        if (surface.monitor >= 0) has_surface[static_cast<size_t>(surface.monitor)] = true;
        if (!surface.casts) continue;
        if (material_of(scene, surface).alpha_mode == AlphaMode::mask)
            throw std::invalid_argument("alpha-masked surfaces cannot be subtracted: " + surface.name);
        if (surface.monitor == static_cast<int>(monitor)) continue;
        for (const auto& [a, b, c] : surface.triangles)
            result.triangles.push_back(
                {seen(surface.positions[a]), seen(surface.positions[b]), seen(surface.positions[c])});
    }
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        if (m == monitor || has_surface[m]) continue;  // panels without a surface hide the others' light as well
        for (const Polygon& panel : scene.monitors[m].panels)
            for (size_t i = 1; i + 1 < panel.corners.size(); ++i)
                result.triangles.push_back(
                    {seen(panel.corners[0]), seen(panel.corners[i]), seen(panel.corners[i + 1])});
    }
    result.is_two_sided = scene.monitors[monitor].two_sided;
    for (const Polygon& polygon : scene.monitors[monitor].panels) {
        Obstructed::Panel& panel = result.panels.emplace_back();
        panel.normal = front_normal(polygon);
        double diameter = 0, largest = 0;
        for (const Vec3& corner : polygon.corners) {
            const Vec3 place = corner - result.center;
            panel.corners.push_back(place);
            panel.center += place / static_cast<double>(polygon.corners.size());
            largest = std::max({largest, std::abs(place.x), std::abs(place.y), std::abs(place.z)});
            for (const Vec3& other : polygon.corners) diameter = std::max(diameter, glm::distance(corner, other));
        }
        panel.clearance = 1e-4 * diameter + 64 * 0.5 * std::numeric_limits<float>::epsilon() * largest;
    }
    return result;
}

SubtractedIrradiance subtract_triangles(const Obstructed& scene, const Vec3& origin, const Vec3& normal,
                                        const Vec3& geometric_normal) {
    SubtractedIrradiance sum;
    for (const Obstructed::Panel& panel : scene.panels) {
        const SubtractedIrradiance some = of_panel(scene, panel, origin - scene.center, normal, geometric_normal);
        sum.unshadowed += some.unshadowed;
        sum.shadowed += some.shadowed;
    }
    return sum;
}

SubtractedIrradiance subtract_triangles(const Obstructed& scene, const RayScene& rays, const SurfacePoint& point) {
    const Vec3 origin = rays.ray_origin(point) - scene.center, place = point.position - scene.center;
    SubtractedIrradiance sum;
    for (const Obstructed::Panel& panel : scene.panels) {
        const LitPanel lit = look_at(scene, panel, place, point.normal);
        const double unshadowed = irradiance({lit.lit}, lit.sight, point.normal);
        sum.unshadowed += unshadowed;
        sum.shadowed += unshadowed * of_panel(scene, panel, origin, point.normal, point.geometric_normal).visibility();
    }
    return sum;
}

}  // namespace surimi::test
