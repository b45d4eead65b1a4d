// SPDX-License-Identifier: Apache-2.0
// The light that the texels of one block get from one monitor.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baker/gather/block_sight.h"
#include "baker/gather/footprint.h"
#include "baker/gather/gather.h"
#include "baker/gather/point_light.h"
#include "baker/texel/texel_surface.h"

namespace surimi {

/// The texels of one block as surfaces.
struct BlockSurfaces {
    std::vector<TexelSurface> texels;
    std::vector<SurfacePoint> centers;
    std::vector<uint64_t> keys;   ///< of the texels' random numbers, without the monitor
    std::vector<char> is_curved;  ///< one point says little about such a texel
    std::vector<char> is_border;  ///< no texel of its chart on some side: nothing tells what happens there
    TileGrid grid{};
    std::array<Vec3, 8> corners;  ///< of a box around all places that rays start from, relative to RayScene::center()
    double texel_size = 0;        ///< metres, root of the largest texel's area
};

/// `members`: indices into texels.texels.
BlockSurfaces block_surfaces(const MonitorSetup& setup, const Atlas& atlas, const Texels& texels,
                             std::span<const uint32_t> members);

/// Memory that is used again from block to block.
struct BlockWorkspace {
    BlockSight sight;
    PointWorkspace point;
    std::vector<PointLight> centers;
    std::vector<double> visibilities;
};

/// What became of a texel.
struct LitTexel {
    IrradianceEstimate estimate;
    bool is_by_center = false;  ///< lit, and judged by its centre alone: what neighbours say may not have been heard
};

/// Writes one for each texel of the block and adds to `statistics` (all but its counts of texels). `footprints`: what
/// is known of the texels' footprint_error; empty: found from the block's own centres.
void light_block(const MonitorSetup& setup, const BlockSurfaces& block, std::span<const double> footprints,
                 BlockWorkspace& work, std::span<LitTexel> texels, GatherStatistics& statistics);

}  // namespace surimi
