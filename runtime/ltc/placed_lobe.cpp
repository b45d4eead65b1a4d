// SPDX-License-Identifier: Apache-2.0
#include "runtime/ltc/placed_lobe.h"

#include "runtime/ltc/line.h"
#include "runtime/ltc/outline.h"
#include "runtime/ltc/polygon.h"
#include "runtime/ltc/table.h"

namespace surimi {

namespace {

constexpr Vec3 up(0, 0, 1);  // normal of the cosine's horizon

bool is_finite_lobe(const PlacedLobe& lobe) {
    const Mat3& m = lobe.to_cosine;
    return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]) && is_finite(lobe.normal) &&
           std::isfinite(lobe.share_above);
}

double share_of(const PlacedLobe& lobe, double irradiance) {
    return irradiance > 0 && lobe.share_above > 0 ? std::min(1.0, irradiance / (pi * lobe.share_above)) : 0;
}

double irradiance_of_transformed(const PlacedLobe& lobe, const Vec3& centre, const std::array<Vec3, 3>& half_axes) {
    const Mat3& m = lobe.to_cosine;
    return irradiance_of_cone(cone_around<double>(m * centre, {m * half_axes[0], m * half_axes[1], m * half_axes[2]}),
                              up);
}

OutlineInLobe<double> outline_in(const PlacedLobe& lobe) {
    OutlineInLobe<double> outline;
    outline.to_cosine = lobe.to_cosine;
    outline.normal = lobe.normal;
    outline.above.normal = up;
    return outline;
}

/// Share of both sides of an ellipse relative to the point. `side` is the sign of its volume with the point, not 0.
double share_of_ellipse(const PlacedLobe& lobe, const Ellipse<double>& ellipse, double side) {
    const double height = glm::dot(lobe.normal, ellipse.centre);
    const double u = glm::dot(lobe.normal, ellipse.half_u), v = glm::dot(lobe.normal, ellipse.half_v);
    const double reach = std::hypot(u, v);
    if (!(height > -reach)) return 0;
    if (height >= reach)
        return share_of(lobe, irradiance_of_transformed(lobe, ellipse.centre, {ellipse.half_u, ellipse.half_v, {}}));
    OutlineInLobe<double> outline = outline_in(lobe);
    // From the lowest point, so that what is above comes in one piece; counter-clockwise about the directions to it.
    add_arc(outline, ellipse, std::atan2(-v, -u), std::copysign(2 * pi, side));
    return share_of(lobe, irradiance_above(outline));
}

}  // namespace

Mat3 frame_of_view(const Vec3& normal, const Vec3& view) {
    if (!is_finite(normal) || !is_finite(view)) return flagged(Mat3(1));
    const Vec3 n = normalize_or(normal, up), v = normalize_or(view, n);
    Vec3 tangent = v - n * glm::dot(n, v);
    const double sine = glm::length(tangent);
    // Below, the difference is mostly rounding; the lobe is round there to far better than any light shows.
    constexpr double least_sine = 1e-12;
    if (!(sine > least_sine)) return frame_around(n);
    tangent /= sine;
    tangent = glm::normalize(tangent - n * glm::dot(n, tangent));
    return {tangent, glm::cross(n, tangent), n};
}

PlacedLobe place_lobe(const Vec3& normal, const Vec3& view, double roughness, LobePart part) {
    if (!is_finite(normal) || !is_finite(view) || !std::isfinite(roughness)) return flagged(PlacedLobe{});
    const Vec3 n = normalize_or(normal, Vec3(0)), v = normalize_or(view, Vec3(0));
    if (n == Vec3(0) || v == Vec3(0)) return {};
    const Mat3 frame = frame_of_view(n, v);
    // Next to the normal the angle is lost in the rounding of its cosine, 1e-8 rad; the sine knows it.
    const double sine = glm::dot(frame[0], v), cosine = glm::dot(n, v);
    const LtcLobe lobe = ltc_lobe(roughness, cosine > 0.9 ? std::sqrt(1 - sine * sine) : cosine, part);
    return {lobe.inverse * glm::transpose(frame), n, 1 - lobe.leak, lobe.albedo};
}

double specular_share_of_polygon(const PlacedLobe& lobe, std::span<const Vec3> corners, const Vec3& point,
                                 bool two_sided) {
    const double largest = largest_offset(corners, point);
    if (!std::isfinite(largest) || !is_finite(point) || !is_finite_lobe(lobe)) return flagged(0.0);
    if (corners.size() < 3 || !(largest > 0)) return 0;
    const double scale = unit_scale(largest);
    PolygonAbove<double> polygon;
    polygon.normal = up;
    const auto add = [&](const Vec3& a, const Vec3& b) {
        const Vec3 p = lobe.to_cosine * a, q = lobe.to_cosine * b;
        add_edge<double>(polygon, {p, p.z}, {q, q.z});
    };
    HorizonGap<double> gap;  // of the true horizon
    const auto elevated = [&](const Vec3& corner) -> Elevated<double> {
        const Vec3 place = (corner - point) * scale;
        return {place, glm::dot(place, lobe.normal)};
    };
    Elevated<double> a = elevated(corners.back());
    double highest = a.height;
    for (const Vec3& corner : corners) {
        const Elevated<double> b = elevated(corner);
        highest = std::max(highest, b.height);
        cut_edge(gap, a, b, add, add);
        a = b;
    }
    if (!(highest > 0)) return 0;
    close_gap(gap, add);
    return share_of(lobe, irradiance_above(polygon, two_sided));
}

double specular_share_of_ellipse(const PlacedLobe& lobe, const Ellipse<double>& ellipse, const Vec3& point,
                                 bool two_sided) {
    Ellipse<double> e{ellipse.centre - point, ellipse.half_u, ellipse.half_v};
    if (!is_finite(e.centre) || !is_finite(e.half_u) || !is_finite(e.half_v) || !is_finite_lobe(lobe))
        return flagged(0.0);
    const std::array<Vec3, 3> vectors = {e.centre, e.half_u, e.half_v};
    const double largest = largest_offset(std::span<const Vec3>(vectors), Vec3(0));
    if (!(largest > 0)) return 0;
    const double scale = unit_scale(largest);
    e = {e.centre * scale, e.half_u * scale, e.half_v * scale};
    const double side = glm::dot(glm::cross(e.half_u, e.half_v), e.centre);
    const bool is_seen = two_sided ? side != 0 : side < 0;
    return is_seen ? share_of_ellipse(lobe, e, side) : 0;
}

double specular_share_of_ellipsoid(const PlacedLobe& lobe, const Ellipsoid<double>& ellipsoid, const Vec3& point) {
    const Vec3 centre = ellipsoid.centre - point;
    const std::array<Vec3, 3>& axes = ellipsoid.half_axes;
    if (!is_finite_lobe(lobe)) return flagged(0.0);
    const EllipticCone<double> cone = cone_around(centre, axes);
    if (cone.is_inside) return 1;
    if (!(cone.b > 0)) return 0;
    const Vec3 reaches(glm::dot(lobe.normal, axes[0]), glm::dot(lobe.normal, axes[1]), glm::dot(lobe.normal, axes[2]));
    const double height = glm::dot(lobe.normal, centre), reach = std::hypot(reaches.x, reaches.y, reaches.z);
    if (!(height > -reach)) return 0;
    if (height >= reach) return share_of(lobe, irradiance_of_transformed(lobe, centre, axes));
    return share_of_ellipse(lobe, {cone.axes[2], cone.a * cone.axes[0], cone.b * cone.axes[1]}, 1);
}

double specular_share_of_cylinder(const PlacedLobe& lobe, const Cylinder<double>& cylinder, const Vec3& point) {
    if (!is_finite_lobe(lobe)) return flagged(0.0);
    const SeenCylinder<double> seen = seen_from(cylinder, point);
    switch (seen.view) {
        case CylinderView::nothing:
            return 0;
        case CylinderView::inside:
            return 1;
        case CylinderView::cap:
            return share_of_ellipse(lobe, seen.from,
                                    glm::dot(glm::cross(seen.from.half_u, seen.from.half_v), seen.from.centre));
        case CylinderView::mantle:
            break;
    }
    OutlineInLobe<double> outline = outline_in(lobe);
    add_outline(outline, seen);
    return share_of(lobe, irradiance_above(outline));
}

double specular_share_of_line(const PlacedLobe& lobe, const Vec3& from, const Vec3& to, const Vec3& point) {
    const std::array<Vec3, 2> ends = {from, to};
    const double largest = largest_offset(std::span<const Vec3>(ends), point);
    if (!std::isfinite(largest) || !is_finite_lobe(lobe)) return flagged(0.0);
    if (!(largest > 0)) return 0;
    const double scale = unit_scale(largest);
    Vec3 a = (from - point) * scale, b = (to - point) * scale;
    if (!(glm::dot(a, lobe.normal) > 0 || glm::dot(b, lobe.normal) > 0)) return 0;
    cut_segment(lobe.normal, a, b);
    // Normal of the plane of the line and the point, before and after the transformation (M18).
    const Vec3 moment = normalize_or(glm::cross(glm::dot(a, a) < glm::dot(b, b) ? a : b, b - a), Vec3(0));
    const Mat3& m = lobe.to_cosine;
    const Mat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double stretch = glm::length(cofactor * moment);
    if (!(stretch > 0) || !(lobe.share_above > 0)) return 0;
    const double narrower = glm::dot(m[0], cofactor[0]) / stretch;
    const double per_width = scale * narrower * irradiance_of_line(m * a, m * b, Vec3(0), up);
    const double share = per_width / (pi * lobe.share_above);
    return share > 0 && std::isfinite(share) ? share : 0;
}

}  // namespace surimi
