// SPDX-License-Identifier: Apache-2.0
#include "tests/support/patches.h"

#include "runtime/map/visibility_map.h"
#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

Vec2 solve(const Vec2& u, const Vec2& v, const Vec2& right) {
    const double determinant = u.x * v.y - u.y * v.x;
    return Vec2(right.x * v.y - right.y * v.x, u.x * right.y - u.y * right.x) / determinant;
}

double look_up_channel(const Channel& channel, const Vec2& texel) {
    VisibilityMap map;
    map.visibility = Image<Vec3f>(channel.visibility.width, channel.visibility.height);
    for (size_t i = 0; i < map.visibility.pixels.size(); ++i)
        map.visibility.pixels[i] = Vec3f(channel.visibility.pixels[i]);
    return look_up(map, texel / Vec2(map.visibility.width, map.visibility.height)).x;
}

void append(Surface& to, const Surface& from) {
    const auto first = static_cast<uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    for (const auto& [i, j, k] : from.triangles) to.triangles.push_back({first + i, first + j, first + k});
}

}  // namespace

Vec2 Patch::texel_at(const Vec3& place) const {
    const Vec3 p = place - corner;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const Vec2 at = solve(Vec2(uu, uv), Vec2(uv, vv), Vec2(glm::dot(p, u), glm::dot(p, v)));
    return texel_corner + at.x * texel_u + at.y * texel_v;
}

Vec3 Patch::place_at(const Vec2& texel) const {
    const Vec2 at = solve(texel_u, texel_v, texel - texel_corner);
    return corner + at.x * u + at.y * v;
}

PatchScene make_patches(const std::vector<Patch>& patches, bool is_one_surface, int size) {
    PatchScene made;
    made.patches = patches;
    made.atlas.width = made.atlas.height = size;
    for (uint32_t p = 0; p < patches.size(); ++p) {
        const Patch& patch = patches[p];
        const uint32_t s = add_quad(made.scene, "Patch", patch.corner, patch.corner + patch.u,
                                    patch.corner + patch.u + patch.v, patch.corner + patch.v);
        SurfaceUv uv;
        uv.page = patch.page;
        made.atlas.pages = std::max(made.atlas.pages, patch.page + 1);
        const std::array<Vec2, 4> corners = {patch.texel_corner, patch.texel_corner + patch.texel_u,
                                             patch.texel_corner + patch.texel_u + patch.texel_v,
                                             patch.texel_corner + patch.texel_v};
        for (const auto& triangle : made.scene.surfaces[s].triangles) {
            std::array<Vec2f, 3> at{};
            for (size_t k = 0; k < 3; ++k) at[k] = Vec2f(corners[triangle[k]] / static_cast<double>(size));
            uv.uv.push_back(at);
            uv.chart.push_back(p);
        }
        made.atlas.charts.push_back({is_one_surface ? 0 : s, glm::length(patch.texel_u) / glm::length(patch.u)});
        made.atlas.surfaces.push_back(uv);
        if (!is_one_surface || p == 0) continue;
        append(made.scene.surfaces[0], made.scene.surfaces[1]);
        made.scene.surfaces.pop_back();
        SurfaceUv& first = made.atlas.surfaces[0];
        first.uv.insert(first.uv.end(), uv.uv.begin(), uv.uv.end());
        first.chart.insert(first.chart.end(), uv.chart.begin(), uv.chart.end());
        made.atlas.surfaces.pop_back();
    }
    return made;
}

std::vector<Channel> paint(const PatchScene& made, double (*of)(const Vec3& place)) {
    const int size = made.atlas.width;
    std::vector<Channel> pages(static_cast<size_t>(made.atlas.pages),
                               {Image<float>(size, size, 1.f), Image<TexelState>(size, size, TexelState::empty)});
    for (const Patch& patch : made.patches) {
        Channel& page = pages[static_cast<size_t>(patch.page)];
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const Vec2 center(x + 0.5, y + 0.5);
                const Vec2 at = solve(patch.texel_u, patch.texel_v, center - patch.texel_corner);
                const Vec2 nearest = patch.texel_corner + std::clamp(at.x, 0.0, 1.0) * patch.texel_u +
                                     std::clamp(at.y, 0.0, 1.0) * patch.texel_v;
                const double away = std::max(std::abs(center.x - nearest.x), std::abs(center.y - nearest.y));
                if (away > 2.5) continue;
                page.state.at(x, y) = away < 0.5 ? TexelState::covered : TexelState::filled;
                const double value = of(patch.place_at(center)) + patch.offset;
                page.visibility.at(x, y) = static_cast<float>(std::clamp(value, 0.0, 1.0));
            }
        }
    }
    return pages;
}

double largest_jump(const std::vector<Channel>& pages, const Patch& one, const Patch& other, const Vec3& a,
                    const Vec3& b) {
    double largest = 0;
    constexpr int places = 331;
    for (int i = 0; i <= places; ++i) {
        const Vec3 place = glm::mix(a, b, static_cast<double>(i) / places);
        const double x = look_up_channel(pages[static_cast<size_t>(one.page)], one.texel_at(place));
        const double y = look_up_channel(pages[static_cast<size_t>(other.page)], other.texel_at(place));
        largest = std::max(largest, std::abs(x - y));
    }
    return largest;
}

}  // namespace surimi::test
