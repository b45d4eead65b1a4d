// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/uv_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace surimi {
namespace {

constexpr float same_uv = 1e-6f;

bool is_before(const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// For each vertex of all surfaces, one after the other, the number of its place.
std::vector<uint32_t> weld(const Scene& scene) {
    std::vector<Vec3> places;
    for (const Surface& surface : scene.surfaces)
        for (const Vec3& p : surface.positions) places.push_back(p + 0.0);
    std::vector<uint32_t> order(places.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return is_before(places[a], places[b]); });
    std::vector<uint32_t> number(places.size());
    uint32_t count = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && is_before(places[order[i - 1]], places[order[i]])) ++count;
        number[order[i]] = count;
    }
    return number;
}

bool comes_first(const EdgeUse& a, const EdgeUse& b) {
    const auto key = [](const EdgeUse& use) {
        return std::tie(use.low, use.high, use.uv_low.x, use.uv_low.y, use.uv_high.x, use.uv_high.y,
                        use.triangle.surface, use.triangle.triangle);
    };
    return key(a) < key(b);
}

}  // namespace

std::vector<EdgeUse> find_edge_uses(const Scene& scene, const std::vector<SurfaceUv>& surfaces) {
    const std::vector<uint32_t> places = weld(scene);
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangle_count(scene));
    size_t first = 0;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        for (uint32_t t = 0; t < surfaces[s].uv.size(); ++t) {
            const auto& uv = surfaces[s].uv[t];
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t next = (k + 1) % 3;
                const uint32_t a = places[first + surface.triangles[t][k]];
                const uint32_t b = places[first + surface.triangles[t][next]];
                if (a < b) uses.push_back({a, b, uv[k], uv[next], {s, t}, k});
                if (b < a) uses.push_back({b, a, uv[next], uv[k], {s, t}, k});
            }
        }
        first += surface.positions.size();
    }
    std::sort(uses.begin(), uses.end(), comes_first);
    return uses;
}

void visit_edges(std::span<const EdgeUse> uses, const std::function<void(std::span<const EdgeUse>)>& visit) {
    for (size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
        visit(uses.subspan(begin, end - begin));
    }
}

bool are_joined(const EdgeUse& a, const EdgeUse& b) {
    const auto is_near = [](const Vec2f& p, const Vec2f& q) {
        return std::abs(p.x - q.x) <= same_uv && std::abs(p.y - q.y) <= same_uv;
    };
    return a.uv_low != a.uv_high && is_near(a.uv_low, b.uv_low) && is_near(a.uv_high, b.uv_high);
}

bool is_cut(std::span<const EdgeUse> edge) {
    for (size_t i = 1; i < edge.size(); ++i)
        if (!are_joined(edge[i - 1], edge[i])) return true;
    return false;
}

bool is_needle(const Surface& surface, uint32_t triangle) {
    const auto& [i, j, k] = surface.triangles[triangle];
    const Vec3 &a = surface.positions[i], &b = surface.positions[j], &c = surface.positions[k];
    const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    return !(0.5 * glm::length(area_normal(a, b, c)) > 1e-12 * longest);
}

}  // namespace surimi
