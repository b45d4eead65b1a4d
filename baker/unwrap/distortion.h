// SPDX-License-Identifier: Apache-2.0
// How much a flattened patch is stretched: Jacobians, the symmetric Dirichlet energy, and the verdict on a chart.
#pragma once

#include <vector>

#include "baker/unwrap/patch.h"

namespace surimi {

/// The map from a triangle's own frame to the plane (M40): its columns are the images of the frame's axes.
inline glm::dmat2 jacobian(const Patch& patch, const std::vector<Vec2>& points, size_t t) {
    const auto& g = patch.gradients[t];
    glm::dmat2 j(0);
    for (size_t k = 0; k < 3; ++k) {
        const Vec2& p = points[patch.triangles[t][k]];
        j[0] += p * g[k].x;
        j[1] += p * g[k].y;
    }
    return j;
}

/// Mean symmetric Dirichlet energy (M41) over the area, 4 for an isometry; infinite when a triangle is flipped or flat.
double symmetric_dirichlet(const Patch& patch, const std::vector<Vec2>& points);

struct Distortion {
    double energy = 4;   ///< mean symmetric Dirichlet energy at the scale at which the patch keeps its area
    double stretch = 1;  ///< 99 % of the area keep at least 1 / stretch of the patch's density in every direction
    bool is_flipped = false;
};

Distortion measure_distortion(const Patch& patch, const std::vector<Vec2>& points);

/// Mean energy above an isometry that goes with a stretch, over (stretch - 1)^2, about.
inline constexpr double energy_of_stretch = 0.4;

/// What a chart may be stretched.
struct DistortionBound {
    double energy = 4.1;
    double stretch = 1.5;
};

inline bool is_within(const Distortion& d, const DistortionBound& bound) {
    return !d.is_flipped && d.energy <= bound.energy && d.stretch <= bound.stretch;
}

}  // namespace surimi
