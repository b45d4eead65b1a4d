// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

using Corners = std::array<Vec2, 3>;

/// Do the closed triangle and the open unit square at (x, y) meet? By separating axes: the square's two, the edges'
/// three.
bool meets_square(const Corners& t, int x, int y) {
    const Vec2 center(x + 0.5, y + 0.5);
    for (int axis = 0; axis < 2; ++axis) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (low >= center[axis] + 0.5 || high <= center[axis] - 0.5) return false;
    }
    for (size_t e = 0; e < 3; ++e) {
        const Vec2 edge = t[(e + 1) % 3] - t[e];
        const Vec2 normal(-edge.y, edge.x);
        const double reach = 0.5 * (std::abs(normal.x) + std::abs(normal.y));
        const double d0 = glm::dot(normal, t[e] - center), d1 = glm::dot(normal, t[(e + 2) % 3] - center);
        if (std::min(d0, d1) >= reach || std::max(d0, d1) <= -reach) return false;
    }
    return true;
}

struct Touch {
    uint32_t texel = 0;
    uint32_t chart = 0;
    TriangleRef triangle;
    auto key() const { return std::tie(texel, chart, triangle.surface, triangle.triangle); }
};

void add_touches(const Atlas& atlas, const TriangleRef& ref, std::vector<Touch>& touches) {
    const Corners t = texel_corners(atlas, ref);
    const uint32_t chart = atlas.surfaces[ref.surface].chart[ref.triangle];
    const auto range = [&](int axis, int size) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        return std::pair{std::clamp(static_cast<int>(std::floor(low)), 0, size - 1),
                         std::clamp(static_cast<int>(std::floor(high)), 0, size - 1)};
    };
    const auto [x0, x1] = range(0, atlas.width);
    const auto [y0, y1] = range(1, atlas.height);
    const size_t before = touches.size();
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
            if (meets_square(t, x, y)) touches.push_back({static_cast<uint32_t>(y * atlas.width + x), chart, ref});
    if (touches.size() > before) return;
    // Flat along a texel border: it meets no open square, so the squares of its box stand in.
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) touches.push_back({static_cast<uint32_t>(y * atlas.width + x), chart, ref});
}

}  // namespace

std::array<Vec2, 3> texel_corners(const Atlas& atlas, const TriangleRef& triangle) {
    Corners corners;
    const auto& uv = atlas.surfaces[triangle.surface].uv[triangle.triangle];
    for (size_t i = 0; i < 3; ++i) corners[i] = Vec2(uv[i]) * Vec2(atlas.width, atlas.height);
    return corners;
}

Texels find_texels(const Scene& scene, const Atlas& atlas, int page) {
    std::vector<std::vector<Touch>> by_surface(scene.surfaces.size());
    parallel_for(scene.surfaces.size(), 1, [&](size_t s) {
        if (atlas.surfaces[s].page != page || atlas.surfaces[s].uv.empty()) return;
        for (uint32_t t = 0; t < scene.surfaces[s].triangles.size(); ++t)
            add_touches(atlas, {static_cast<uint32_t>(s), t}, by_surface[s]);
    });
    std::vector<Touch> touches;
    for (const auto& some : by_surface) touches.insert(touches.end(), some.begin(), some.end());
    std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) { return a.key() < b.key(); });

    Texels result;
    result.page = page;
    result.width = atlas.width;
    result.height = atlas.height;
    for (const Touch& touch : touches) {
        const bool is_new = result.texels.empty() || result.texels.back().index != touch.texel;
        if (is_new)
            result.texels.push_back({touch.texel, touch.chart, static_cast<uint32_t>(result.triangles.size()), 0});
        if (touch.chart != result.texels.back().chart) continue;
        ++result.texels.back().count;
        result.triangles.push_back(touch.triangle);
    }
    return result;
}

}  // namespace surimi
