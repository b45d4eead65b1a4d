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

/// One texel that at least one triangle touches. The last four are for find_exposures() to say.
struct Texel {
    uint32_t index = 0;  ///< y * width + x; with the page, it keys the random numbers
    uint32_t chart = 0;
    uint32_t first = 0;  ///< its triangles are Texels::triangles[first, first + count)
    uint32_t count = 0;

    static constexpr uint32_t all_pieces = 0xffffff;
    /// Bit i: piece i of its surface, cut at contacts, is not inside other geometry. all_pieces: nothing of it is.
    uint32_t free_pieces = all_pieces;
    bool may_turn = false;       ///< its back is lit by a monitor that cannot light its front
    bool is_touched = false;     ///< other surfaces touch it or come through it
    bool is_mostly_free = true;  ///< at least half of it is not inside other geometry

    bool is_inside() const { return free_pieces == 0; }
};

/// Of one page. Sorted by index; each index at most once.
struct Texels {
    int page = 0;
    int width = 0;
    int height = 0;
    std::vector<Texel> texels;
    std::vector<TriangleRef> triangles;

    /// One for each texel of all pages; keys its random numbers.
    uint64_t key_of(const Texel& texel) const {
        const auto page_size = static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
        return static_cast<uint64_t>(page) * page_size + texel.index;
    }

    std::span<const TriangleRef> triangles_of(const Texel& texel) const {
        return {triangles.data() + texel.first, texel.count};
    }
};

/// Rows of a map, from the one to before the other.
struct Rows {
    int begin = 0, end = 0;
};

/// Conservative: a texel is listed when the closed triangle and the open texel square meet, and a triangle that meets
/// no open square (it lies on texel borders) is listed with the texels beside it. Where two charts touch one texel
/// (existing UVs only), the chart of the lower number owns it.
Texels find_texels(const Scene& scene, const Atlas& atlas, int page = 0);

/// Numbers of texels, from the one to before the other.
struct Numbers {
    size_t begin = 0, end = 0;

    size_t count() const { return end - begin; }
};

/// Of the texels that lie in these rows. Rows outside the map have none.
Numbers numbers_in(const Texels& texels, const Rows& rows);

/// The texels that lie in these rows, on the same map. Their numbers begin at 0.
Texels texels_in(const Texels& texels, const Rows& rows);

/// Largest factor of subdivided().
inline constexpr int most_subdivided = 4;

/// The texels of a finer map under these, as far as they lie in `rows` of that map: `fine` is their atlas with width
/// and height times one factor of 1 to most_subdivided. A triangle of a texel is listed with those of its subtexels
/// that find_texels() would list it with, and only there, so that a subtexel has the chart of its texel. It is as free
/// as its texel; of one that is partly inside other geometry expose_parts() has to say what each subtexel is.
Texels subdivided(const Texels& texels, const Atlas& fine, const Rows& rows);

/// Where the triangle lies on the map, in texels.
std::array<Vec2, 3> texel_corners(const Atlas& atlas, const TriangleRef& triangle);

}  // namespace surimi
