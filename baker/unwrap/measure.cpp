// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/measure.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "baker/unwrap/coverage.h"
#include "baker/unwrap/uv_edges.h"

namespace surimi {
namespace {

/// Area on the map below 1e-9 of the longest edge squared is rounding.
constexpr double least_flat_area = 1e-9;

FlatTriangle texels_of(const Atlas& atlas, const TriangleRef& ref) {
    FlatTriangle texels;
    const auto& uv = atlas.surfaces[ref.surface].uv[ref.triangle];
    for (size_t k = 0; k < 3; ++k) texels[k] = Vec2(uv[k]) * Vec2(atlas.width, atlas.height);
    return texels;
}

double area_in_space(const Surface& surface, uint32_t t) {
    const auto& [i, j, k] = surface.triangles[t];
    return 0.5 * glm::length(area_normal(surface.positions[i], surface.positions[j], surface.positions[k]));
}

bool has_flat_area(const FlatTriangle& texels) {
    return 0.5 * std::abs(doubled_area(texels)) > least_flat_area * longest_edge_squared(texels);
}

/// Numbers with the area that they hold on.
struct Weighted {
    std::vector<std::pair<double, double>> items;

    void add(double value, double weight) { items.emplace_back(value, weight); }

    double mean() const {
        double sum = 0, weights = 0;
        for (const auto& [value, weight] : items) sum += value * weight, weights += weight;
        return weights > 0 ? sum / weights : 0;
    }
    /// The least value that, with all smaller ones, holds on `share` of the area.
    double quantile(double share) {
        std::sort(items.begin(), items.end());
        double weights = 0, so_far = 0;
        for (const auto& item : items) weights += item.second;
        for (const auto& [value, weight] : items)
            if ((so_far += weight) >= share * weights) return value;
        return items.empty() ? 0 : items.back().first;
    }
};

/// A triangle with area in space and on the map.
struct Piece {
    Stretch stretch;
    double space = 0;   ///< square metres
    double texels = 0;  ///< square texels
};

/// The pieces; counts what is degenerate or collapsed.
std::vector<Piece> pieces_of(const Scene& scene, const Atlas& atlas, UnwrapNumbers& numbers) {
    std::vector<Piece> pieces;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
        for (uint32_t t = 0; t < atlas.surfaces[s].uv.size(); ++t) {
            const double space = area_in_space(scene.surfaces[s], t);
            numbers.area += space;
            ++numbers.triangles;
            const FlatTriangle texels = texels_of(atlas, {s, t});
            if (is_needle(scene.surfaces[s], t))
                ++numbers.degenerate_triangles;
            else if (!has_flat_area(texels))
                ++numbers.collapsed_triangles;
            else
                pieces.push_back({stretch_of(scene, atlas, s, t), space, 0.5 * std::abs(doubled_area(texels))});
        }
    return pieces;
}

void count_charts(const Scene& scene, const Atlas& atlas, UnwrapNumbers& numbers) {
    std::vector<size_t> triangles(atlas.charts.size(), 0);
    std::vector<double> winding(atlas.charts.size(), 0);
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
        for (uint32_t t = 0; t < atlas.surfaces[s].uv.size(); ++t) {
            if (is_needle(scene.surfaces[s], t)) continue;
            const uint32_t chart = atlas.surfaces[s].chart[t];
            ++triangles[chart];
            winding[chart] += doubled_area(texels_of(atlas, {s, t}));
        }
    for (size_t c = 0; c < triangles.size(); ++c) {
        numbers.charts += triangles[c] > 0;
        numbers.single_triangle_charts += triangles[c] == 1;
        numbers.mirrored_charts += winding[c] < 0;
    }
}

void measure_stretch(const std::vector<Piece>& pieces, double texels_of_map, UnwrapNumbers& numbers) {
    double space = 0, texels = 0;
    for (const Piece& piece : pieces) space += piece.space, texels += piece.texels;
    if (!(space > 0) || !(texels > 0)) return;
    const double scale = std::sqrt(texels / space);  // texels a metre on average
    Weighted squares, energy, angle, area, density;
    for (const Piece& piece : pieces) {
        const double s1 = piece.stretch.largest * scale;
        const double s2 = piece.stretch.smallest * scale;
        if (!(s2 > 0) || !std::isfinite(s1)) continue;
        numbers.linf_stretch = std::max(numbers.linf_stretch, s1);
        squares.add(0.5 * (s1 * s1 + s2 * s2), piece.space);
        energy.add(s1 * s1 + s2 * s2 + 1 / (s1 * s1) + 1 / (s2 * s2), piece.space);
        angle.add(s1 / s2, piece.space);
        area.add(std::max(s1 * s2, 1 / (s1 * s2)), piece.space);
        density.add(1 / piece.stretch.largest, piece.space);
    }
    numbers.l2_stretch = std::sqrt(squares.mean());
    numbers.symmetric_dirichlet = energy.mean();
    numbers.angle_mean = angle.mean();
    numbers.angle_p99 = angle.quantile(0.99);
    numbers.area_mean = area.mean();
    numbers.area_p99 = area.quantile(0.99);
    numbers.density_p1 = density.quantile(0.01);
    numbers.density_p50 = density.quantile(0.5);
    numbers.density_p99 = density.quantile(0.99);
    numbers.area_share = texels / texels_of_map;
    numbers.density_efficiency = numbers.area * numbers.density_p1 * numbers.density_p1 / texels_of_map;
}

/// Sides of edges, those of degenerate triangles left out.
std::vector<EdgeUse> edge_uses(const Scene& scene, const Atlas& atlas) {
    std::vector<EdgeUse> uses = find_edge_uses(scene, atlas.surfaces);
    std::erase_if(uses, [&](const EdgeUse& use) {
        return is_needle(scene.surfaces[use.triangle.surface], use.triangle.triangle);
    });
    return uses;
}

/// Whether an edge lies between two triangles that bend little there.
bool is_smooth(const Scene& scene, std::span<const EdgeUse> edge) {
    if (edge.size() != 2) return false;
    std::array<Vec3, 2> normals;
    for (size_t i = 0; i < 2; ++i) {
        const Surface& surface = scene.surfaces[edge[i].triangle.surface];
        const auto& [a, b, c] = surface.triangles[edge[i].triangle.triangle];
        normals[i] = area_normal(surface.positions[a], surface.positions[b], surface.positions[c]);
    }
    return std::atan2(glm::length(glm::cross(normals[0], normals[1])), glm::dot(normals[0], normals[1])) < smooth_bend;
}

double length_of(const Scene& scene, const EdgeUse& use) {
    const Surface& surface = scene.surfaces[use.triangle.surface];
    const auto& corners = surface.triangles[use.triangle.triangle];
    return glm::length(surface.positions[corners[use.corner]] - surface.positions[corners[(use.corner + 1) % 3]]);
}

void measure_seams(const Scene& scene, const Atlas& atlas, UnwrapNumbers& numbers) {
    visit_edges(edge_uses(scene, atlas), [&](std::span<const EdgeUse> edge) {
        if (!is_cut(edge)) return;
        const double length = length_of(scene, edge[0]);
        numbers.seam_length += length;
        if (is_smooth(scene, edge)) numbers.smooth_seam_length += length;
    });
    if (!(numbers.area > 0)) return;
    numbers.seam_over_root_area = numbers.seam_length / std::sqrt(numbers.area);
    numbers.smooth_seam_over_root_area = numbers.smooth_seam_length / std::sqrt(numbers.area);
}

double touched_share(const Atlas& atlas, int page) {
    const glm::ivec2 size(atlas.width, atlas.height);
    const auto touched = touched_charts(place_triangles(atlas, page, size), size).pixels;
    const auto empty = std::count(touched.begin(), touched.end(), no_chart);
    return touched.empty() ? 0 : 1 - static_cast<double>(empty) / static_cast<double>(touched.size());
}

}  // namespace

Stretch stretch_of(const Scene& scene, const Atlas& atlas, uint32_t surface, uint32_t triangle) {
    const Surface& in_space = scene.surfaces[surface];
    const FlatTriangle texels = texels_of(atlas, {surface, triangle});
    if (is_needle(in_space, triangle) || !has_flat_area(texels)) return {};
    const auto& [i, j, k] = in_space.triangles[triangle];
    const Vec3 e1 = in_space.positions[j] - in_space.positions[i];
    const Vec3 e2 = in_space.positions[k] - in_space.positions[i];
    const Vec2 d1 = texels[1] - texels[0];
    const Vec2 d2 = texels[2] - texels[0];
    const double doubled = doubled_area(texels);
    const Vec3 along_x = (e1 * d2.y - e2 * d1.y) / doubled;
    const Vec3 along_y = (e2 * d1.x - e1 * d2.x) / doubled;
    const double a = glm::dot(along_x, along_x);
    const double b = glm::dot(along_x, along_y);
    const double c = glm::dot(along_y, along_y);
    const double largest = std::sqrt(0.5 * (a + c + std::hypot(a - c, 2 * b)));
    if (!(largest > 0)) return {};
    // Their product is the ratio of the areas: keeps the digits of slivers.
    return {largest, 2 * area_in_space(in_space, triangle) / std::abs(doubled) / largest};
}

UnwrapNumbers measure(const Scene& scene, const Atlas& atlas) {
    UnwrapNumbers numbers;
    const double texels = static_cast<double>(atlas.width) * atlas.height * atlas.pages;
    measure_stretch(pieces_of(scene, atlas, numbers), texels, numbers);
    count_charts(scene, atlas, numbers);
    measure_seams(scene, atlas, numbers);
    for (int page = 0; page < atlas.pages; ++page) numbers.touched_share += touched_share(atlas, page) / atlas.pages;
    return numbers;
}

std::vector<ChartSide> chart_sides(const Scene& scene, const Atlas& atlas) {
    std::vector<ChartSide> sides;
    visit_edges(edge_uses(scene, atlas), [&](std::span<const EdgeUse> edge) {
        const bool is_smooth_seam = is_cut(edge) && is_smooth(scene, edge);
        for (size_t i = 0; i < edge.size(); ++i) {
            const bool is_inside = (i > 0 && are_joined(edge[i - 1], edge[i])) ||
                                   (i + 1 < edge.size() && are_joined(edge[i], edge[i + 1]));
            if (!is_inside) sides.push_back({edge[i].triangle, edge[i].corner, is_smooth_seam});
        }
    });
    return sides;
}

}  // namespace surimi
