// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tests/support/random.h"

namespace surimi {
namespace {

Texels texels_of(int width, int height, uint32_t charts) {
    Texels texels;
    texels.width = width;
    texels.height = height;
    Random random{9};
    for (uint32_t i = 0; i < static_cast<uint32_t>(width * height); ++i)
        if (random.next() < 0.8) texels.texels.push_back({i, static_cast<uint32_t>(random.next() * charts), 0, 1});
    return texels;
}

TEST(Blocks, HoldEveryTexelOnceByTileAndChart) {
    for (const auto& [width, height] : {std::pair{64, 40}, std::pair{61, 43}, std::pair{3, 5}}) {
        const Texels texels = texels_of(width, height, 3);
        const Blocks blocks = find_blocks(texels);
        std::vector<uint32_t> all;
        std::set<std::tuple<uint32_t, uint32_t, uint32_t>> seen;
        for (size_t b = 0; b < blocks.count(); ++b) {
            ASSERT_FALSE(blocks[b].empty());
            EXPECT_LE(blocks[b].size(), size_t{tile_size} * tile_size);
            EXPECT_TRUE(std::ranges::is_sorted(blocks[b]));
            const auto key = [&](uint32_t i) {
                const Texel& texel = texels.texels[i];
                const auto w = static_cast<uint32_t>(width);
                return std::tuple(texel.index / w / tile_size, texel.index % w / tile_size, texel.chart);
            };
            for (const uint32_t i : blocks[b]) {
                EXPECT_EQ(key(i), key(blocks[b].front()));
                all.push_back(i);
            }
            EXPECT_TRUE(seen.insert(key(blocks[b].front())).second) << "one block for a tile's chart";
        }
        std::ranges::sort(all);
        ASSERT_EQ(all.size(), texels.texels.size());
        for (uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
    }
}

TEST(Blocks, NoTexelsMakeNoBlocks) {
    const Blocks blocks = find_blocks(Texels{0, 16, 16, {}, {}});
    EXPECT_EQ(blocks.count(), 0u);
}

}  // namespace
}  // namespace surimi
