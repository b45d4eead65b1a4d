// SPDX-License-Identifier: Apache-2.0
// A linearly transformed cosine: the lobe that four numbers give at a view angle and a roughness.
#pragma once

#include "runtime/base/math.h"

namespace surimi {

/// GGX with Schlick's reflectance is F0 times one lobe plus 1 - F0 times another (M30): `full` stands for GGX with
/// reflectance 1, `schlick` for GGX times (1 - V.H)^5, which lies elsewhere, at grazing half vectors.
enum class LobePart { full, schlick };

/// The four free numbers of a lobe, in the frame of the mirror direction and in units of the width that GGX has there
/// (M24). All are of order 1; (1, 0, 0, 1) is the limit of small roughness.
struct LobeShape {
    double along = 1;  ///< narrower than the limit, in the plane of incidence
    double lift = 0;   ///< moves the peak out of the mirror direction
    double skew = 0;   ///< makes one flank steeper
    double depth = 1;  ///< wider than the limit, in both directions
};

/// Inverse of the matrix that makes the lobe from a clamped cosine (M24), with middle entry 1, for the frame (tangent
/// of the view's plane, bitangent, normal). `alpha` and `cosine` (N.V) in (0, 1].
inline Mat3 inverse_matrix(const LobeShape& shape, double alpha, double cosine) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double scale = std::hypot(cosine, alpha * sine), width = 2 * alpha;
    // Coordinates along the tangent (cosine, 0, sine) of the mirror direction and the mirror direction (-sine, 0,
    // cosine).
    const double tangent = scale * shape.along, tilt = scale * width * shape.lift;
    const double skew = width * shape.skew, depth = scale * width * shape.depth;
    return {Vec3(tangent * cosine - tilt * sine, 0, skew * cosine - depth * sine), Vec3(0, 1, 0),
            Vec3(tangent * sine + tilt * cosine, 0, skew * sine + depth * cosine)};
}

/// Density of the lobe in 1/sr at a unit direction (M23).
inline double lobe_density(const Mat3& inverse, const Vec3& light) {
    const Vec3 q = inverse * light;
    const double length2 = glm::dot(q, q);
    return q.z > 0 ? (inverse[0].x * inverse[2].z - inverse[2].x * inverse[0].z) * q.z / (pi * length2 * length2) : 0;
}

/// Fraction of the lobe below the horizon of the surface (M25), in [0, 1].
inline double lobe_below_horizon(const Mat3& inverse) {
    const double x = inverse[0].x, y = inverse[0].z, length = std::hypot(x, y);
    if (!(length > 0)) return 0;
    return x > 0 ? y * y / (2 * length * (length + x)) : (1 - x / length) / 2;  // the first without cancellation
}

}  // namespace surimi
