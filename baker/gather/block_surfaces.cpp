// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "baker/gather/block_light.h"
#include "baker/gather/exposure.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

/// A box along the block's own axes: flat charts lie flat in it.
std::array<Vec3, 8> box_around(std::span<const Vec3> places, const Vec3& normal) {
    const Vec3 up = normalize_or(normal, {0, 0, 1});
    Vec3 across(0);
    for (const Vec3& place : places) {
        const Vec3 d = place - places.front();
        if (glm::dot(d, d) > glm::dot(across, across)) across = d;
    }
    const Vec3 other = std::abs(up.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = normalize_or(across - glm::dot(across, up) * up, normalize_or(glm::cross(up, other), {1, 0, 0}));
    const Mat3 axes(u, glm::cross(up, u), up);
    Vec3 low(INFINITY), high(-INFINITY);
    for (const Vec3& place : places) {
        const Vec3 local = glm::transpose(axes) * place;
        low = glm::min(low, local);
        high = glm::max(high, local);
    }
    std::array<Vec3, 8> corners;
    for (size_t i = 0; i < 8; ++i)
        corners[i] = axes * Vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    return corners;
}

/// Do normals at its corners differ by more than some 15 degrees from those at the centre?
bool is_curved(const TexelSurface& surface, const SurfacePoint& center) {
    bool is_curved = false;
    surface.for_each_corner([&](const SurfacePoint& corner) {
        is_curved = is_curved || glm::dot(corner.normal, center.normal) < 0.966 ||
                    glm::dot(corner.geometric_normal, center.geometric_normal) < 0.966;
    });
    return is_curved;
}

}  // namespace

BlockSurfaces block_surfaces(const MonitorSetup& setup, const Atlas& atlas, const Texels& texels,
                             std::span<const uint32_t> members) {
    const RayScene& rays = setup.rays;
    const Receivers receivers{setup.scene, atlas, texels, rays, setup.settings.lifts_smooth};
    BlockSurfaces block;
    block.texels.reserve(members.size());
    block.grid.fill(-1);
    const auto width = static_cast<uint32_t>(texels.width);
    std::vector<Vec3> places;
    Vec3 normals(0);
    double largest = 0;
    for (const uint32_t member : members) {
        const Texel& texel = texels.texels[member];
        const TexelSurface& surface = block.texels.emplace_back(exposed_surface(receivers, texel, setup.panels));
        block.grid[cell_in_tile(texel.index, width)] = static_cast<int16_t>(block.centers.size());
        block.centers.push_back(surface.center());
        block.keys.push_back(texels.key_of(texel));
        surface.for_each_corner([&](const SurfacePoint& corner) {
            places.push_back(rays.ray_origin(corner) - rays.center());
            normals += corner.geometric_normal;
        });
        block.is_partial.push_back(texel.free_pieces != Texel::all_pieces);
        block.is_curved.push_back(is_curved(surface, block.centers.back()));
        // A texel of one plane may be judged at a place between its pieces.
        places.push_back(rays.ray_origin(block.centers.back()) - rays.center());
        largest = std::max(largest, surface.area());
    }
    block.corners = box_around(places, normals);
    block.texel_size = std::sqrt(largest);
    return block;
}

}  // namespace surimi
