// SPDX-License-Identifier: Apache-2.0
// Scenes that cast shadows: the rooms of the study of visibility (research/sampling.md), and one of everything that
// breaks geometry.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi::test {

/// What stands in a room of 10 x 10 x 3.5 m.
enum class Contents {
    low,     ///< 24 boxes, 4 pillars, a shelf of 10 boards: 804 triangles with the room
    mid,     ///< and 10 balls and 10 rings: 103,204
    high,    ///< low and 12 noisy blobs: 983,844
    leaf,    ///< 10 trunks with 5000 loose leaves each: 100,492
    million  ///< mid and high: 1,086,244
};

/// Three monitors: R, 3.2 x 1.8 m on a wall; G, 1.2 x 1.2 m at the ceiling; B, 0.6 x 0.34 m on the opposite side.
Scene room_with(Contents contents);

/// By the names above. Throws std::invalid_argument for others.
Contents contents_named(const std::string& name);

/// The surfaces of the room and of its plain furniture: what is worth a lightmap in every one of these rooms.
std::vector<uint32_t> plain_surfaces(const Scene& room);

/// The same room and monitors with boxes that touch and interpenetrate, exact duplicates, T junctions, slivers,
/// triangles that are degenerate in float, coplanar decals, boxes and sheets that cut through monitors, a bezel that
/// touches its screen's border, and monitors that are glued to a wall (R), let into a plate (B) and in front of nothing
/// (G).
Scene nasty_room();

}  // namespace surimi::test
