// SPDX-License-Identifier: Apache-2.0
#include "baker/post/border_edges.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "baker/texel/texels.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

// A corner went through the nodes' matrices: some products and sums of floats, for each of the two surfaces.
constexpr double roundings = 8;
// Of an edge's length and its triangle's height over it, so that no edge is taken for another of the same mesh.
constexpr double largest_share = 1.0 / 16;

struct UvEdge {
    uint32_t chart = 0;
    Vec2f low{0};  ///< its ends on the map, in the order of their coordinates
    Vec2f high{0};
    uint32_t corner = 0;  ///< 3 * triangle + the corner from which it runs to the next

    auto place() const { return std::tie(chart, low.x, low.y, high.x, high.y); }
};

/// The corners, as 3 * triangle + corner, whose edges no other triangle of the chart shares on the map.
std::vector<uint32_t> border_corners(const SurfaceUv& surface) {
    std::vector<UvEdge> edges;
    edges.reserve(3 * surface.uv.size());
    for (uint32_t t = 0; t < surface.uv.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const Vec2f a = surface.uv[t][k], b = surface.uv[t][(k + 1) % 3];
            const bool is_upwards = std::tie(a.x, a.y) < std::tie(b.x, b.y);
            if (a != b) edges.push_back({surface.chart[t], is_upwards ? a : b, is_upwards ? b : a, 3 * t + k});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const UvEdge& a, const UvEdge& b) { return a.place() < b.place(); });
    std::vector<uint32_t> corners;
    for (size_t i = 0; i < edges.size(); ++i) {
        const bool is_shared = (i > 0 && edges[i].place() == edges[i - 1].place()) ||
                               (i + 1 < edges.size() && edges[i].place() == edges[i + 1].place());
        if (!is_shared) corners.push_back(edges[i].corner);
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// How far rounding may have moved the vertices of a surface.
double rounding_of(const Surface& surface) {
    double largest = 0;
    for (const Vec3& position : surface.positions) largest = std::max(largest, largest_component(position));
    return roundings * static_cast<double>(std::numeric_limits<float>::epsilon()) * largest;
}

BorderEdge border_edge(const Scene& scene, const Atlas& atlas, uint32_t s, uint32_t corner) {
    const Surface& surface = scene.surfaces[s];
    const uint32_t t = corner / 3;
    const std::array<uint32_t, 2> at = {corner % 3, (corner + 1) % 3};
    const auto texels = texel_corners(atlas, {s, t});
    const auto& triangle = surface.triangles[t];
    BorderEdge edge;
    for (size_t end = 0; end < 2; ++end) {
        edge.ends[end] = surface.positions[triangle[at[end]]];
        edge.normals[end] = surface.normals[triangle[at[end]]];
        edge.texels[end] = texels[at[end]];
    }
    const Vec3 area =
        area_normal(surface.positions[triangle[0]], surface.positions[triangle[1]], surface.positions[triangle[2]]);
    edge.face = Vec3f(normalize_or(area, edge.normals[0]));
    edge.chart = atlas.surfaces[s].chart[t];
    edge.page = atlas.surfaces[s].page;
    edge.length = glm::length(edge.ends[1] - edge.ends[0]);
    const double height = edge.length > 0 ? glm::length(area) / edge.length : 0;
    edge.tolerance = largest_share * std::min(edge.length, height);
    return edge;
}

}  // namespace

std::vector<BorderEdge> find_border_edges(const Scene& scene, const Atlas& atlas) {
    std::vector<std::vector<BorderEdge>> found(scene.surfaces.size());
    parallel_for(scene.surfaces.size(), 1, [&](size_t s) {
        if (atlas.surfaces[s].uv.empty()) return;
        const double rounding = rounding_of(scene.surfaces[s]);
        for (const uint32_t corner : border_corners(atlas.surfaces[s])) {
            BorderEdge edge = border_edge(scene, atlas, static_cast<uint32_t>(s), corner);
            edge.tolerance = std::min(edge.tolerance, rounding);
            const bool has_density = atlas.charts[edge.chart].texels_per_metre > 0;
            if (has_density && edge.length > 0) found[s].push_back(edge);
        }
    });
    std::vector<BorderEdge> edges;
    size_t count = 0;
    for (const auto& some : found) count += some.size();
    edges.reserve(count);
    for (auto& some : found) {
        edges.insert(edges.end(), some.begin(), some.end());
        some = {};
    }
    return edges;
}

}  // namespace surimi
