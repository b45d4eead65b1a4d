// SPDX-License-Identifier: Apache-2.0
// Monitors that touch what is around them.
#pragma once

#include "tests/scenes/artefact_scene.h"

namespace surimi::test {

/// A convex room with a monitor `gap` metres before one wall, or behind its face where negative. The wall neither
/// blocks nor gets its light: all that is lit is exactly 1.
ArtefactScene screen_on_a_wall(double gap);

/// What a screen may have before it.
enum class Cover {
    mesh,  ///< opaque, as a screen's fabric is modelled
    glass  ///< with transmission
};

/// A room whose monitor, 1 cm off the wall, has a plate of its own size 2 mm before it. That is part of the screen and
/// does not block it: all that is lit is exactly 1.
ArtefactScene screen_behind(Cover cover);

/// A room whose monitor stands on the floor, at a right angle. Where the floor is before it, it is exactly 1 up to the
/// monitor's edge; behind it the wall is hidden and dark.
ArtefactScene screen_on_the_floor();

/// Cards of leaves between a monitor and a floor: one double-sided quad whose mask is open on one half. The floor has
/// exactly the shadow of the other half.
ArtefactScene card_with_a_hole();

/// Two double-sided cards that cross, and one behind them, all with the monitor at their back. Their backs are no
/// inside of anything: no texel is `inside`, and the floor has exactly their shadow.
ArtefactScene cards_lit_from_behind();

/// One double-sided card with the monitor at its back: light on its back counts, so it is measured and exactly 1.
ArtefactScene card_lit_from_behind();

}  // namespace surimi::test
