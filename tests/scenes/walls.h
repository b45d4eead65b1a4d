// SPDX-License-Identifier: Apache-2.0
// Walls that leak, and things that stand in one another.
#pragma once

#include "tests/scenes/artefact_scene.h"

namespace surimi::test {

/// Two rooms with a wall of 1 cm between them, a fifth of a texel, each with faces of its own. The first, with the
/// monitor, is exactly lit; the second exactly dark.
ArtefactScene two_rooms();

/// One floor that runs under a wall of 1 cm. Texels on either side of it are exactly 1 and exactly 0; those that it
/// stands on have the average over what is beside it.
ArtefactScene two_rooms_on_one_floor();

/// A closed room with the monitor outside, turned so that no wall lies along an axis: exactly dark. `thickness` of its
/// walls in metres; 0: they have an inner side only.
ArtefactScene closed_room(double thickness);

/// A box sunk into a floor. Floor beside it and the part of it above the floor have the visibility of what can be seen
/// of each texel, so in front of the box exactly 1: there is no rim.
ArtefactScene box_sunk_into_a_floor();

/// The same box upon the floor, its bottom in the floor's plane: the same values.
ArtefactScene box_upon_a_floor();

/// Two boxes that interpenetrate: each has the visibility of what can be seen of each texel.
ArtefactScene boxes_that_interpenetrate();

/// Three boxes side by side, their sides in contact, their tops in one plane: the tops are exactly 1, without lines at
/// the joints.
ArtefactScene boxes_in_a_row();

/// A rug in the very plane of the floor: neither hides the light from the other, both are exactly 1.
ArtefactScene rug_in_the_plane_of_a_floor();

/// A poster 1 mm behind a wall's face: the wall is exactly 1, and of the poster no texel that counts is lit.
ArtefactScene poster_behind_a_wall();

/// A poster 1 mm before a wall: both exactly 1 wherever the wall can be seen, up to the poster's border.
ArtefactScene poster_before_a_wall();

}  // namespace surimi::test
