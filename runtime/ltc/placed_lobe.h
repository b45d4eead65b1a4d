// SPDX-License-Identifier: Apache-2.0
// The lobe of GGX at a place: what a point with a normal, a view and a roughness reflects of lights of every shape.
#pragma once

#include <span>

#include "runtime/ltc/cylinder.h"
#include "runtime/ltc/ellipse.h"
#include "runtime/ltc/lobe.h"

namespace surimi {

/// The lobe where it stands. Lights are cut at the true horizon, brought into the space in which the lobe is a clamped
/// cosine, cut at the horizon there, and integrated; the result is divided by what of the lobe is above the true
/// horizon (M25), so a whole sky reflects `albedo` and a light below the surface nothing.
struct PlacedLobe {
    Mat3 to_cosine{1};       ///< from world directions to the cosine's space
    Vec3 normal{0, 0, 1};    ///< unit; of the true horizon
    double share_above = 1;  ///< of the lobe, above the true horizon, in (0, 1]
    double albedo = 0;       ///< of this part of the BRDF: specular albedo = F0 * full + (1 - F0) * schlick (M30)
};

/// The orthonormal, right-handed frame (columns tangent, bitangent, normal) whose tangent is on the view's side of the
/// normal, in their plane; any tangent where the two are parallel (M16). Neither needs unit length; a normal without
/// any counts as (0, 0, 1). Input that is not finite gives the identity and raises FE_INVALID.
Mat3 frame_of_view(const Vec3& normal, const Vec3& view);

/// The lobe for a unit normal, a unit direction to the eye and a perceptual roughness in [0, 1]. A view along the
/// normal leaves the tangent open, and the lobe is round there; a view at or below the horizon, as interpolated
/// normals give, counts as the least angle above it in the same plane. Light reflected from a monitor of radiance L is
/// L (F0 a s + (1 - F0) a' s') with albedo and share of the full and of the schlick part. A normal or view without
/// length gives a lobe of albedo 0; so does input that is not finite, and raises FE_INVALID.
PlacedLobe place_lobe(const Vec3& normal, const Vec3& view, double roughness, LobePart part = LobePart::full);

/// Share of the lobe that a light fills, in [0, 1], as seen from `point` (M17); times the specular albedo and the
/// light's radiance it is the radiance reflected to the eye. The rules of irradiance_of_... hold: which side emits,
/// points inside, lights without area. A light that does not rise above the true horizon gives exactly
/// 0. Input that is not finite gives 0 and raises FE_INVALID.
double specular_share_of_polygon(const PlacedLobe& lobe, std::span<const Vec3> corners, const Vec3& point,
                                 bool two_sided = false);
double specular_share_of_ellipse(const PlacedLobe& lobe, const Ellipse<double>& ellipse, const Vec3& point,
                                 bool two_sided = false);
double specular_share_of_ellipsoid(const PlacedLobe& lobe, const Ellipsoid<double>& ellipsoid, const Vec3& point);
double specular_share_of_cylinder(const PlacedLobe& lobe, const Cylinder<double>& cylinder, const Vec3& point);
/// Of a line, per metre of its width, in 1/m (M18); not bounded, as irradiance_of_line.
double specular_share_of_line(const PlacedLobe& lobe, const Vec3& from, const Vec3& to, const Vec3& point);

}  // namespace surimi
