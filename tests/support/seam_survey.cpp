// SPDX-License-Identifier: Apache-2.0
#include "tests/support/seam_survey.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace surimi::test {
namespace {

struct Edge {
    Vec3 from{0}, to{0};  ///< in lexical order
    SeamEdge::Side side;

    auto key() const { return std::tie(from.x, from.y, from.z, to.x, to.y, to.z); }
    auto order() const {
        return std::tuple_cat(
            key(), std::tie(side.triangle.surface, side.triangle.triangle, side.corners[0], side.corners[1]));
    }
};

std::vector<Edge> all_edges(const Scene& scene) {
    std::vector<Edge> edges;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        if (surface.monitor >= 0) continue;
        for (uint32_t t = 0; t < surface.triangles.size(); ++t)
            for (size_t c = 0; c < 3; ++c) {
                const size_t next = (c + 1) % 3;
                const Vec3 a = surface.positions[surface.triangles[t][c]] + 0.0;  // -0 becomes 0
                const Vec3 b = surface.positions[surface.triangles[t][next]] + 0.0;
                const bool is_ordered = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
                edges.push_back(is_ordered ? Edge{a, b, {{s, t}, {c, next}}} : Edge{b, a, {{s, t}, {next, c}}});
            }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.order() < b.order(); });
    return edges;
}

Vec2f uv_of(const Atlas& atlas, const SeamEdge::Side& side, size_t end) {
    return atlas.surfaces[side.triangle.surface].uv[side.triangle.triangle][side.corners[end]];
}

bool is_together_on_map(const Atlas& atlas, const SeamEdge::Side& a, const SeamEdge::Side& b) {
    return atlas.surfaces[a.triangle.surface].page == atlas.surfaces[b.triangle.surface].page &&
           uv_of(atlas, a, 0) == uv_of(atlas, b, 0) && uv_of(atlas, a, 1) == uv_of(atlas, b, 1);
}

const Vec3& normal_of(const Scene& scene, const SeamEdge::Side& side, size_t end) {
    const Surface& surface = scene.surfaces[side.triangle.surface];
    return surface.normals[surface.triangles[side.triangle.triangle][side.corners[end]]];
}

/// The triangle's third corner, seen from the edge.
Vec3 inwards(const Scene& scene, const Edge& edge) {
    const Surface& surface = scene.surfaces[edge.side.triangle.surface];
    const size_t third = 3 - edge.side.corners[0] - edge.side.corners[1];
    const Vec3 d = surface.positions[surface.triangles[edge.side.triangle.triangle][third]] - edge.from;
    const Vec3 along = normalize_or(edge.to - edge.from, {1, 0, 0});
    return d - glm::dot(d, along) * along;
}

bool is_smooth(const Scene& scene, const Edge& a, const Edge& b) {
    const double least = std::cos(8 * pi / 180);
    for (size_t end = 0; end < 2; ++end)
        if (glm::dot(normal_of(scene, a.side, end), normal_of(scene, b.side, end)) < least) return false;
    return glm::dot(inwards(scene, a), inwards(scene, b)) < 0;
}

/// Uv at `share` of the way along an edge.
Vec2 uv_along(const Atlas& atlas, const SeamEdge::Side& side, double share) {
    return glm::mix(Vec2(uv_of(atlas, side, 0)), Vec2(uv_of(atlas, side, 1)), share);
}

bool is_measured(const Bake& bake, const SeamEdge::Side& side, double share, size_t channel) {
    const BakedPage& page = bake.pages[static_cast<size_t>(bake.atlas.surfaces[side.triangle.surface].page)];
    const Image<TexelState>& state = page.state[channel];
    const Vec2 at = uv_along(bake.atlas, side, share) * Vec2(state.width, state.height);
    const int x = std::clamp(static_cast<int>(at.x), 0, state.width - 1);
    const int y = std::clamp(static_cast<int>(at.y), 0, state.height - 1);
    return state.at(x, y) == TexelState::covered;
}

double read_along(const Bake& bake, const SeamEdge::Side& side, double share, size_t channel) {
    const BakedPage& page = bake.pages[static_cast<size_t>(bake.atlas.surfaces[side.triangle.surface].page)];
    return look_up(page.map, uv_along(bake.atlas, side, share))[static_cast<int>(channel)];
}

double texels_along(const Bake& bake, const SeamEdge::Side& side) {
    const Vec2 size(bake.atlas.width, bake.atlas.height);
    return glm::length((Vec2(uv_of(bake.atlas, side, 1)) - Vec2(uv_of(bake.atlas, side, 0))) * size);
}

}  // namespace

std::vector<SeamEdge> find_seam_edges(const Scene& scene, const Atlas& atlas) {
    const std::vector<Edge> edges = all_edges(scene);
    std::vector<SeamEdge> seams;
    for (size_t first = 0, last = 0; first < edges.size(); first = last) {
        while (last < edges.size() && edges[last].key() == edges[first].key()) ++last;
        if (last - first > 8) continue;  // a fan of copies: no seam that one could see
        for (size_t i = first; i < last; ++i)
            for (size_t j = i + 1; j < last; ++j)
                if (!is_together_on_map(atlas, edges[i].side, edges[j].side) && is_smooth(scene, edges[i], edges[j]))
                    seams.push_back({{edges[i].side, edges[j].side}});
    }
    return seams;
}

double SeamJumps::quantile(double share) const {
    if (places.empty()) return 0;
    return places[static_cast<size_t>(share * static_cast<double>(places.size() - 1))].jump;
}

double SeamJumps::share_over(double jump) const {
    if (places.empty()) return 0;
    const auto over = std::count_if(places.begin(), places.end(), [&](const SeamPlace& p) { return p.jump > jump; });
    return static_cast<double>(over) / static_cast<double>(places.size());
}

SurfacePoint point_beside(const Scene& scene, const SeamEdge& edge, size_t side, double share) {
    constexpr double inwards = 0.01;
    const auto& [triangle, corners] = edge.sides[side];
    Vec3 weights(inwards);
    weights[static_cast<int>(corners[0])] = (1 - inwards) * (1 - share);
    weights[static_cast<int>(corners[1])] = (1 - inwards) * share;
    return surface_point(scene, triangle, weights);
}

SeamJumps seam_jumps(const Bake& bake, const std::vector<SeamEdge>& edges, size_t channel) {
    SeamJumps found;
    for (size_t e = 0; e < edges.size(); ++e) {
        const auto& [first, second] = edges[e].sides;
        const double texels = std::max(texels_along(bake, first), texels_along(bake, second));
        const int count = std::max(1, static_cast<int>(std::ceil(4 * texels)));
        const size_t before = found.places.size();
        for (int i = 0; i < count; ++i) {
            const double share = (i + 0.5) / count;
            if (!is_measured(bake, first, share, channel) || !is_measured(bake, second, share, channel)) continue;
            const double jump = read_along(bake, first, share, channel) - read_along(bake, second, share, channel);
            found.places.push_back({std::abs(jump), e, share});
        }
        found.edges += found.places.size() > before;
    }
    std::stable_sort(found.places.begin(), found.places.end(),
                     [](const SeamPlace& a, const SeamPlace& b) { return a.jump < b.jump; });
    return found;
}

}  // namespace surimi::test
