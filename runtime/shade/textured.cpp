// SPDX-License-Identifier: Apache-2.0
#include "runtime/shade/textured.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace surimi {
namespace {

/// Standard deviations of the blur where the lobe is narrower than the panel, in distances to it, and where the panel
/// limits it, in roots of its area: the pair with the least error over random views of a panel cut into 4 x 4
/// (docs/decisions.md). The lobe alone would want 0.85 (M33), an evenly seen square 0.29.
constexpr double lobe_sigma = 0.5, panel_sigma = 0.2;

/// The part of a convex polygon above z = 0.
std::vector<Vec3> above_horizon(std::span<const Vec3> corners) {
    std::vector<Vec3> above;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if (a.z >= 0) above.push_back(a);
        if ((a.z >= 0) != (b.z >= 0)) above.push_back((a * b.z - b * a.z) / (b.z - a.z));
    }
    return above;
}

/// Sum over the edges of angle times normal (M1): the direction in which the light arrives, on the mean.
Vec3 vector_irradiance(std::span<const Vec3> corners) {
    Vec3 sum(0);
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const Vec3 c = glm::cross(a, b);
        const double sine = glm::length(c);
        if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) / sine * c;
    }
    return sum;
}

Vec3 area_vector(std::span<const Vec3> corners) {
    Vec3 sum(0);
    for (size_t i = 1; i + 1 < corners.size(); ++i) sum += area_normal(corners[0], corners[i], corners[i + 1]);
    return 0.5 * sum;
}

}  // namespace

std::vector<LightPiece> pieces_of(const Monitor& monitor, int cells) {
    std::vector<LightPiece> pieces;
    for (size_t panel = 0; panel < monitor.panels.size(); ++panel) {
        const std::vector<Vec3>& c = monitor.panels[panel].corners;
        if (c.size() != 4 || cells == 1) {
            pieces.push_back({panel, c});
            continue;
        }
        const auto at = [&](int i, int j) {  // bilinear, so that neighbours share their edges
            const double u = static_cast<double>(i) / cells, v = static_cast<double>(j) / cells;
            return glm::mix(glm::mix(c[0], c[1], u), glm::mix(c[3], c[2], u), v);
        };
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i)
                pieces.push_back({panel, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
    return pieces;
}

Vec3 picture_seen(const MonitorPicture& picture, size_t panel, std::span<const Vec3> corners, const Vec3& point,
                  const Mat3& to_cosine) {
    std::vector<Vec3> seen;
    for (const Vec3& corner : corners) seen.push_back(to_cosine * (corner - point));
    const Vec3 mean = Vec3(picture.levels.back().pixels.front());
    const Vec3 area_seen = area_vector(seen);
    const std::vector<Vec3> above = above_horizon(seen);
    const Vec3 toward = normalize_or(vector_irradiance(above), Vec3(0));
    const double slope = glm::dot(toward, area_seen), height = glm::dot(seen[0], area_seen);
    // Negative where the corners turn so that the sum points away; times `toward` it leads to the panel all the same.
    const double along = height / slope, distance = std::abs(along), size = glm::length(area_seen);
    if (!(distance > 0) || !std::isfinite(distance) || !(size > 0)) return mean;  // edge-on or unseen
    // The plane's map from the lobe's space back to the world is affine: one ratio of areas for all of it.
    const double area = glm::length(area_vector(corners)), scale = std::sqrt(area / size);
    const double foreshortening = std::sqrt(std::abs(slope) / size);
    const Vec3 place = point + glm::inverse(to_cosine) * (along * toward);
    const double by_lobe = lobe_sigma * distance * scale / std::max(foreshortening, 1e-3);
    const double by_panel = panel_sigma * std::sqrt(area);
    const double sigma = by_lobe * by_panel / std::hypot(by_lobe, by_panel);
    return blurred_picture_at(picture, panel, place, sigma);
}

}  // namespace surimi
