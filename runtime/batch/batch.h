// SPDX-License-Identifier: Apache-2.0
// Polygon lights on many points at once: the integrals of runtime/ltc in SIMD, for the processor at hand.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/ltc/lobe.h"

namespace surimi {

/// Numbers of many points, structure of arrays.
struct Vec3Batch {
    std::vector<double> x, y, z;
    void push_back(const Vec3& v) { x.push_back(v.x), y.push_back(v.y), z.push_back(v.z); }
    Vec3 operator[](size_t i) const { return {x[i], y[i], z[i]}; }
    size_t size() const { return x.size(); }
    void clear() { x.clear(), y.clear(), z.clear(); }
};

/// Points to shade. All arrays have one length.
struct PointBatch {
    Vec3Batch position;             ///< metres
    Vec3Batch normal;               ///< unit
    Vec3Batch view;                 ///< unit, towards the eye
    std::vector<double> roughness;  ///< perceptual, in [0, 1]
    size_t size() const { return roughness.size(); }
};

/// Lobes of one part of the BRDF at the points, which do not depend on the lights: place_lobe of each point.
struct LobeBatch {
    Vec3Batch tangent;                   ///< unit; the bitangent is cross(normal, tangent)
    std::vector<double> xx, xz, zx, zz;  ///< inverse matrix of the lobe: row letter first, middle entry 1 (M24)
    std::vector<double> share_above;     ///< PlacedLobe::share_above
    std::vector<double> albedo;          ///< PlacedLobe::albedo; 0 where the input was not finite
};

/// Shares of one light, or sums over several: irradiance / pi, and share of the lobe; both in [0, 1] for one light.
struct ShareBatch {
    std::vector<double> diffuse, specular;
    size_t not_finite = 0;  ///< points that got 0 because something about them was not finite
};

/// `full` is exact to rounding in double. `mixed` does the geometry in double and the angles of the edges in float: its
/// shares are wrong by at most 4.2e-7 wherever the light is, and by about 1e-7 over the light's angular size relative
/// to themselves; lights of less than 0.01 rad are computed in double (M15).
enum class Precision { mixed, full };

/// What of a light is wanted; the other half of the shares is left as it is.
enum class Terms { diffuse, specular, both };

/// place_lobe for every point. Resizes `lobes`.
void place_lobes(const PointBatch& points, LobeBatch& lobes, LobePart part = LobePart::full);

/// Adds the shares of one planar convex polygon (three corners or more, counter-clockwise seen from the side that
/// emits; with fewer nothing is added) to `shares`, whose arrays have the points' length. `is_wanted`, empty or one
/// flag for each point, lets points be left out: their shares stay as they are, and whole blocks of them cost nothing.
/// `lobes` may be empty where only the diffuse share is wanted. A point's result depends on nothing but itself and the
/// instruction set: not on the other points or on its place among them. A light or a point that is not finite adds
/// nothing and is counted.
void add_polygon(const PointBatch& points, const LobeBatch& lobes, std::span<const Vec3> corners, bool two_sided,
                 Terms terms, Precision precision, std::span<const uint8_t> is_wanted, ShareBatch& shares);

/// Names of the instruction sets that this processor and this build have, best first: "AVX3", "AVX2", "SSE4", ...
std::vector<std::string> instruction_sets();

/// Uses one of instruction_sets() from now on; the best again for an empty name. For measurements and tests: results
/// differ in the last digits between instruction sets. Not thread-safe.
void use_instruction_set(const std::string& name);

}  // namespace surimi
