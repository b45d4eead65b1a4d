// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/blocks.h"

#include <algorithm>
#include <utility>

namespace surimi {

Blocks find_blocks(const Texels& texels) {
    const auto width = static_cast<uint32_t>(texels.width);
    const uint32_t tiles_across = (width + tile_size - 1) / tile_size;
    const auto key = [&](uint32_t i) {
        const Texel& texel = texels.texels[i];
        const uint32_t tile = texel.index / width / tile_size * tiles_across + texel.index % width / tile_size;
        return std::pair(tile, texel.chart);
    };
    Blocks blocks;
    blocks.order.reserve(texels.texels.size());
    for (uint32_t i = 0; i < texels.texels.size(); ++i)
        if (!texels.texels[i].is_inside()) blocks.order.push_back(i);
    std::ranges::sort(blocks.order, [&](uint32_t a, uint32_t b) {
        const auto key_a = key(a), key_b = key(b);
        return key_a < key_b || (key_a == key_b && a < b);
    });
    for (uint32_t i = 0; i < blocks.order.size(); ++i)
        if (i == 0 || key(blocks.order[i]) != key(blocks.order[i - 1])) blocks.starts.push_back(i);
    blocks.starts.push_back(static_cast<uint32_t>(blocks.order.size()));
    return blocks;
}

}  // namespace surimi
