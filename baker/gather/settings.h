// SPDX-License-Identifier: Apache-2.0
// What the user asks of the visibility, and how a texel's value came about.
#pragma once

#include <cstdint>

namespace surimi {

/// Which way to find visibility where neither certificate nor a single ray decides it.
enum class Method {
    automatic,   ///< the cheapest that reaches the error, block by block
    split,       ///< the panel cut along every silhouette: exact
    scanline,    ///< intervals along lines on the panel
    monte_carlo  ///< rays
};

inline constexpr int largest_supersample = 4;

struct GatherSettings {
    double error = 0.004;  ///< of a texel's visibility: 99.9 % of texels are within it, the RMSE within half; in (0, 1]
    bool is_exact =
        false;  ///< every point by splitting; what is left is the texel's footprint, at a quarter of `error`
    Method method = Method::automatic;
    int samples = 0;  ///< rays for each texel and monitor with Method::monte_carlo; 0: as many as `error` takes
    uint64_t seed = 0;
    bool clears_covers = true;  ///< what lies flat on a monitor does not block it (cover.h)
    bool lifts_smooth = true;   ///< coarse smooth surfaces are seen as round as their normals say (lift.h)
    int supersample = 1;  ///< subtexels along a texel's side that light is gathered on, 1 to largest_supersample (M64)
    int band_rows = 0;    ///< rows of the map that are worked on at a time, a multiple of tile_size; 0: rows_of_band();
                          ///< the result does not depend on them
};

/// What decided a texel's visibility; the strongest means that any of its points needed. The numbers stand in files.
enum class TexelMethod : uint8_t {
    none = 0,         ///< unlit, or no texel
    certificate = 1,  ///< one facet hides the monitor from the whole block
    ray = 2,          ///< no silhouette in the way: one ray for a point
    split = 3,
    scanline = 4,
    monte_carlo = 5
};
inline constexpr int texel_method_count = 6;

}  // namespace surimi
