// SPDX-License-Identifier: Apache-2.0
// Which monitor reaches which surface, before anything is lit: facing, distances, and what a coarse grid of blocks
// says of what stands between.
#pragma once

#include <vector>

#include "baker/gather/settings.h"
#include "baker/preparation.h"

namespace surimi {

/// What is known of blocks of texels before they are lit.
struct BlockCounts {
    size_t seen = 0;         ///< blocks looked at; each is one of the following
    size_t unlit = 0;        ///< the monitor is behind or below the horizon of all their texels' centres
    size_t hidden = 0;       ///< behind one facet: dark by certificate
    size_t open = 0;         ///< no silhouette can be in the way: one ray for a texel
    size_t silhouettes = 0;  ///< silhouettes in the way
    size_t cutouts = 0;      ///< an alpha-masked surface in the way: rays alone
    size_t crowded = 0;      ///< so many silhouettes that rays are cheaper, or the settings want rays
    size_t candidates = 0;   ///< silhouettes in the way of all of them

    size_t lit() const { return seen - unlit; }
    void add(const BlockCounts& other);
};

/// One surface under one monitor.
struct Reach {
    double facing =
        0;  ///< share of its area in front of the monitor and with some of that above the triangles' horizon
    double nearest = 0;   ///< metres from that area to the middle of the nearest panel; 0 where there is none
    double farthest = 0;  ///< metres from that area to the middle of the farthest panel
    BlockCounts blocks;
};

/// One for each of Scene::surfaces; nothing reaches those that do not receive. Blocks: some evenly spaced ones of each
/// surface, the same in every run. Costs one ray for a panel and block, and those that tell what stands on its texels.
std::vector<Reach> find_reach(const Scene& scene, const Preparation& preparation, size_t monitor,
                              const GatherSettings& settings);

}  // namespace surimi
