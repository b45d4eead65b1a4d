// SPDX-License-Identifier: Apache-2.0
// Which texels a study looks at: whole blocks at random, because engines work in blocks, and some texels of each.
#pragma once

#include <vector>

#include "baker/texel/texels.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// A texel under a monitor.
struct StudiedTexel {
    size_t monitor = 0;  ///< of Scene::monitors
    size_t page = 0;
    size_t texel = 0;  ///< of Selection::blocks[monitor][page].texels
};

struct Selection {
    std::vector<std::vector<Texels>> blocks;  ///< [monitor][page]: all texels of the chosen blocks
    std::vector<StudiedTexel> texels;         ///< lit ones among them, every lit texel of the map equally likely
    size_t block_count = 0;
    size_t lit_in_blocks = 0;  ///< pairs of a texel of the chosen blocks and the monitor that lights it
    size_t lit = 0;            ///< the same over the whole map
};

/// Chooses about `count` pairs of a texel and a monitor that lights it, up to four in a block of 8 x 8 texels. Blocks
/// are drawn with a probability that grows with their lit texels. Fewer when there are not so many. Depends on the
/// seed, not on the number of threads.
Selection choose_texels(const Scene& scene, const Atlas& atlas, const std::vector<Texels>& pages, size_t count,
                        uint64_t seed);

}  // namespace surimi
