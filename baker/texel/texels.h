// SPDX-License-Identifier: Apache-2.0
// Atlas -> texels: which triangles each lightmap texel of a page touches.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

/// One texel that at least one triangle touches. `free_pieces` and `may_turn` are for find_exposures() to say.
struct Texel {
    uint32_t index = 0;  ///< y * width + x; with the page, it keys the random numbers
    uint32_t chart = 0;
    uint32_t first = 0;  ///< its triangles are Texels::triangles[first, first + count)
    uint32_t count = 0;

    static constexpr uint32_t all_pieces = 0xffffff;
    /// Bit i: piece i of its surface, cut at contacts, is not inside other geometry. all_pieces: nothing of it is.
    uint32_t free_pieces = all_pieces;
    bool may_turn = false;  ///< its back is lit by a monitor that cannot light its front

    bool is_inside() const { return free_pieces == 0; }
};

/// Of one page. Sorted by index; each index at most once.
struct Texels {
    int page = 0;
    int width = 0;
    int height = 0;
    std::vector<Texel> texels;
    std::vector<TriangleRef> triangles;

    std::span<const TriangleRef> triangles_of(const Texel& texel) const {
        return {triangles.data() + texel.first, texel.count};
    }
};

/// Conservative: a texel is listed when the closed triangle and the open texel square meet, and a triangle that meets
/// no open square (it lies on texel borders) is listed with the texels beside it. Where two charts touch one texel
/// (existing UVs only), the chart of the lower number owns it.
Texels find_texels(const Scene& scene, const Atlas& atlas, int page = 0);

/// Where the triangle lies on the map, in texels.
std::array<Vec2, 3> texel_corners(const Atlas& atlas, const TriangleRef& triangle);

}  // namespace surimi
