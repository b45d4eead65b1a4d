// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/distortion.h"

#include <algorithm>

namespace surimi {

double symmetric_dirichlet(const Patch& patch, const std::vector<Vec2>& points) {
    double sum = 0;
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        const glm::dmat2 j = jacobian(patch, points, t);
        const double determinant = glm::determinant(j);
        if (!(determinant > 0)) return INFINITY;
        const double squares = glm::dot(j[0], j[0]) + glm::dot(j[1], j[1]);
        sum += patch.areas[t] * (squares + squares / (determinant * determinant));
    }
    return sum;
}

Distortion measure_distortion(const Patch& patch, const std::vector<Vec2>& points) {
    Distortion result;
    struct Share {
        double smaller;  ///< singular value
        double area;
    };
    std::vector<Share> shares;
    shares.reserve(patch.triangles.size());
    double flat_area = 0;
    double squares = 0;   // mean of s1^2 + s2^2
    double inverses = 0;  // mean of 1 / s1^2 + 1 / s2^2
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        const glm::dmat2 j = jacobian(patch, points, t);
        const double determinant = glm::determinant(j);
        if (!(determinant > 0)) {
            result.is_flipped = true;
            result.energy = result.stretch = INFINITY;
            return result;
        }
        const double sum = glm::dot(j[0], j[0]) + glm::dot(j[1], j[1]);
        // Largest singular value from the sum and difference of both, the smaller one from the product.
        const double larger =
            0.5 * (std::sqrt(sum + 2 * determinant) + std::sqrt(std::max(0.0, sum - 2 * determinant)));
        shares.push_back({determinant / larger, patch.areas[t]});
        flat_area += patch.areas[t] * determinant;
        squares += patch.areas[t] * sum;
        inverses += patch.areas[t] * sum / (determinant * determinant);
    }
    // Scaled so that the patch keeps its area, which is 1.
    result.energy = squares / flat_area + inverses * flat_area;
    std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.smaller < b.smaller; });
    constexpr double left_out = 0.01;  // of the area
    double area = 0;
    size_t i = 0;
    while (i + 1 < shares.size() && (area += shares[i].area) < left_out) ++i;
    result.stretch = std::sqrt(flat_area) / shares[i].smaller;
    return result;
}

}  // namespace surimi
