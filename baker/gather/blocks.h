// SPDX-License-Identifier: Apache-2.0
// Texels of one chart in tiles of the map: what lies close together is judged together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "baker/texel/texels.h"

namespace surimi {

inline constexpr int tile_size = 8;  ///< texels a side; measured, see docs/decisions.md

/// Where the texel of this index lies in its tile: y * tile_size + x.
constexpr size_t cell_in_tile(uint32_t index, uint32_t width) {
    return size_t{index / width % tile_size} * tile_size + index % width % tile_size;
}

struct Blocks {
    std::vector<uint32_t> order;   ///< indices into Texels::texels, block by block; in a block as in Texels
    std::vector<uint32_t> starts;  ///< block b is order[starts[b], starts[b + 1])

    size_t count() const { return starts.size() - 1; }
    std::span<const uint32_t> operator[](size_t b) const {
        return {order.data() + starts[b], starts[b + 1] - starts[b]};
    }
};

/// Of all texels that are not inside other geometry.
Blocks find_blocks(const Texels& texels);

}  // namespace surimi
