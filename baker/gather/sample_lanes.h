// SPDX-License-Identifier: Apache-2.0
// The arithmetic of Monte Carlo samples, many at a time in the lanes of the processor.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/base/math.h"
#include "runtime/base/random.h"

namespace surimi {

/// Samples that are drawn together.
struct SampleLanes {
    static constexpr size_t count = 64;
    template <class T>
    using Lanes = std::array<T, count>;
    using Vectors = std::array<Lanes<double>, 3>;

    /// Numbers in [0, 1), [dimension][lane]; from scramble.
    alignas(64) std::array<Lanes<double>, 4> numbers;

    // For weigh. Places are relative to RayScene::center().
    alignas(64) Vectors position;          ///< of the texel's point
    alignas(64) Vectors normal;            ///< there, unit, for shading
    alignas(64) Vectors geometric_normal;  ///< unit
    alignas(64) Vectors to_origin;         ///< from the position to where rays start
    alignas(64) Vectors target;            ///< the monitor's point
    alignas(64) Vectors panel_normal;      ///< unit, front side

    // From weigh.
    alignas(64) std::array<Lanes<float>, 3> origin, direction;  ///< of the ray
    alignas(64) Lanes<float> weight;  ///< cos cos / r^2 of the two points (M6), irradiance up to the monitor's area; 0
                                      ///< where either is behind the other
    alignas(64) Lanes<float> end;     ///< in directions' lengths. No ray is needed where it is `shadowed` or `open`
    static constexpr float shadowed = -1;  ///< the surface itself is in the way, though the shading normal is not
    static constexpr float open = 0;       ///< nothing counts as an occluder so close to the panel

    static void set(Vectors& vectors, size_t lane, const Vec3& v) {
        for (size_t c = 0; c < 3; ++c) vectors[c][lane] = v[static_cast<int>(c)];
    }
};

/// Owen-scrambled Sobol points, by their digits ([dimension], `SampleLanes::count` of each, first digit lowest).
void scramble(const std::array<const uint32_t*, 4>& digits, const Scrambling& seeds, SampleLanes& lanes);

/// Weights and rays of all lanes. Rays end `clearance` metres before the panel's plane.
void weigh(double clearance, bool is_two_sided, SampleLanes& lanes);

}  // namespace surimi
