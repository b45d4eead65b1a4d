// SPDX-License-Identifier: Apache-2.0
// What may stand between a block of texels and each panel of a monitor.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "baker/gather/monitor_setup.h"
#include "baker/gather/segments.h"

namespace surimi {

struct PanelSight {
    const Panel* panel = nullptr;
    bool is_hidden = false;    ///< one facet stands between the whole block and the panel (M51)
    Candidates candidates;     ///< edges that may be silhouettes for points of the block
    size_t first_cut = 0;      ///< of the candidates: those from here on are the clearance's cuts
    std::vector<size_t> near;  ///< candidates whose shadows on the block may be narrower than a texel
};

struct BlockSight {
    std::vector<PanelSight> panels;  ///< [0, count): panels that some point of the block is in front of
    size_t count = 0;
    double texel_size = 0;        ///< metres, of the largest texel of the block
    bool has_cutouts = false;     ///< an alpha-masked surface may be in the way: only rays tell
    std::vector<uint32_t> found;  ///< memory of the queries

    size_t candidates() const;
    bool is_hidden() const;  ///< all panels are
};

/// `corners`: of a convex volume that holds all points that rays start from, relative to RayScene::center().
/// The arrays of `sight` are reused. Returns the rays used.
size_t look_from(BlockSight& sight, const MonitorSetup& setup, std::span<const Vec3> corners, double texel_size);

}  // namespace surimi
