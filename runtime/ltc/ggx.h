// SPDX-License-Identifier: Apache-2.0
// The BRDF that the lobes of linearly transformed cosines stand for: height-correlated Smith GGX without Fresnel.
#pragma once

#include <vector>

#include "runtime/base/math.h"

namespace surimi {

/// f cos at normal (0, 0, 1), in 1/sr (M20); both directions are unit vectors, 0 where one is at or below the horizon.
/// `alpha` in (0, 1] is the slope roughness, the square of the perceptual one.
double ggx_times_cosine(double alpha, const Vec3& view, const Vec3& light);

/// Draws a direction by the distribution of visible normals (M21), from two numbers in [0, 1). It may lie below the
/// horizon, where the BRDF is 0.
Vec3 sample_ggx(double alpha, const Vec3& view, double u, double v);

/// Density of `sample_ggx` in 1/sr (M21), 0 where the half vector or the view is below the horizon.
double ggx_density(double alpha, const Vec3& view, const Vec3& light);

/// One node of a quadrature over the hemisphere of light directions.
struct GgxNode {
    Vec3 light;
    double half_cosine;  ///< V.H
    double value;        ///< f cos, 1/sr
    double weight;       ///< solid angle, of this node and of its mirror image at -y
};

/// Quadrature over the upper hemisphere for the view (sqrt(1 - cosine^2), 0, cosine), in polar coordinates of the
/// microfacets' slope, where the horizon is a circle and the integrand smooth (M22): `around` (even) half-planes times
/// `along` nodes. Only y > 0 is listed, because everything is even in y. `alpha` and `cosine` in (0, 1].
std::vector<GgxNode> ggx_nodes(double alpha, double cosine, int around, int along);

/// Directional albedo: the integral of f cos, and the same weighted with (1 - V.H)^5 of Schlick 1994. The specular
/// albedo with reflectance F0 at normal incidence is F0 * full + (1 - F0) * fresnel.
struct GgxAlbedo {
    double full;
    double fresnel;
};
GgxAlbedo ggx_albedo(double alpha, double cosine);

}  // namespace surimi
