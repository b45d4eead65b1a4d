// SPDX-License-Identifier: Apache-2.0
// What a point reflects: Lambert and GGX, with the light that the one takes missing in the other.
#pragma once

#include "runtime/material/shading_point.h"

namespace surimi {

/// Share of white light from everywhere that the GGX part sends to the eye (M30), for each colour in [0, 1].
/// The albedos are those of the two parts' lobes.
inline Vec3 specular_albedo(const Vec3& f0, double full, double schlick) {
    return f0 * full + (1.0 - f0) * schlick;
}

/// What the Lambert and the GGX part reflect; of reflectances or of radiance.
struct Parts {
    Vec3 diffuse{0};
    Vec3 specular{0};
    Vec3 sum() const { return diffuse + specular; }
    Parts& operator+=(const Parts& other) {
        diffuse += other.diffuse, specular += other.specular;
        return *this;
    }
};

inline Parts operator*(const Vec3& factor, const Parts& parts) {
    return {factor * parts.diffuse, factor * parts.specular};
}

/// The BRDF at one point, seen from one direction: what does not depend on the light, worked out once.
struct Brdf {
    Mat3 frame{1};           ///< columns: tangent in the plane of the view, bitangent, normal
    Vec3 view{0, 0, 1};      ///< in the frame; above the horizon
    Vec3 diffuse_albedo{0};  ///< after the share that GGX takes
    Vec3 f0{0.04};
    double alpha = 1;           ///< slope roughness
    double specular_share = 0;  ///< of the samples that follow GGX, the rest follows the cosine
};

Brdf brdf_at(const ShadingPoint& point);

/// f cos in 1/sr (M30) at a unit direction in the world; 0 below the horizon.
Parts reflectance(const Brdf& brdf, const Vec3& light);

/// Draws a unit direction in the world from three numbers in [0, 1): GGX (M21) or the cosine, mixed by
/// `specular_share`. It may lie below the horizon, where nothing is reflected.
Vec3 sample_direction(const Brdf& brdf, double choice, double u, double v);

/// Density of sample_direction, 1/sr.
double direction_density(const Brdf& brdf, const Vec3& light);

}  // namespace surimi
