// SPDX-License-Identifier: Apache-2.0
// Scenes of quads with UVs of their own, in texels of a map of 64 x 64.
#pragma once

#include <array>
#include <string>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi::test {

inline constexpr int uv_map = 64;

/// A rectangle in texels.
struct Texels4 {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// A quad a, b, c, d (counter-clockwise seen from its front) that lies on this rectangle of the map.
inline Surface uv_quad(const std::string& name, const std::array<Vec3, 4>& corners, const Texels4& r) {
    Surface surface;
    surface.name = name;
    surface.positions = {corners.begin(), corners.end()};
    surface.normals.assign(4, Vec3(0, 0, 1));
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
    surface.uv_sets = {{}, {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}};
    for (Vec2& uv : surface.uv_sets[1]) uv /= uv_map;
    return surface;
}

/// The unit square at (x, 0, 0).
inline std::array<Vec3, 4> unit_square(double x) {
    return {Vec3(x, 0, 0), Vec3(x + 1, 0, 0), Vec3(x + 1, 1, 0), Vec3(x, 1, 0)};
}

/// A quad of 16 x 16 texels, and another, elsewhere in space, `gap` texels beside it on the map.
inline Scene two_quads(double gap) {
    Scene scene;
    scene.surfaces.push_back(uv_quad("left", unit_square(0), {8, 8, 24, 24}));
    scene.surfaces.push_back(uv_quad("right", unit_square(5), {24 + gap, 8, 40 + gap, 24}));
    return scene;
}

/// The scene's UVs as an atlas of one chart for each surface.
inline Atlas atlas_of(const Scene& scene) {
    Atlas atlas;
    atlas.width = atlas.height = uv_map;
    for (const Surface& surface : scene.surfaces) {
        SurfaceUv& uv = atlas.surfaces.emplace_back();
        for (const auto& t : surface.triangles) {
            uv.uv.push_back(
                {Vec2f(surface.uv_sets[1][t[0]]), Vec2f(surface.uv_sets[1][t[1]]), Vec2f(surface.uv_sets[1][t[2]])});
            uv.chart.push_back(static_cast<uint32_t>(atlas.charts.size()));
        }
        atlas.charts.push_back({static_cast<uint32_t>(atlas.surfaces.size() - 1), 16});
    }
    return atlas;
}

}  // namespace surimi::test
