// SPDX-License-Identifier: Apache-2.0
// One scene in several sizes and places, and as files whose nodes mirror and flatten it.
#pragma once

#include <filesystem>

#include "tests/scenes/artefact_scene.h"

namespace surimi::test {

/// A room with furniture and a monitor, 4 x 2.5 x 4 m, with UVs of its own for a map of room_map texels a side. Scaled
/// by 1e-3 and by 1e4 and moved 1e5 m away, its map is the same within the error.
ArtefactScene furnished_room();

inline constexpr int room_map = 256;

/// Writes a .glb whose floor stands under a monitor with a block on either side of it, the second of them the mirror
/// image of the first by a node with scale (-1, 1, 1). Every value at a place is that at its mirror image, with the
/// sides of the two blocks swapped.
void write_mirrored_blocks(const std::filesystem::path& file);

/// The same file with another node of the block, scaled by 0: as if that node were not there, bit for bit.
void write_blocks_and_nothing(const std::filesystem::path& file);

/// The same file with another node of the block, scaled by (1, 0, 1), which lies in the floor's plane: it hides
/// nothing.
void write_blocks_and_a_flat_one(const std::filesystem::path& file);

}  // namespace surimi::test
