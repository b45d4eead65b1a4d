// SPDX-License-Identifier: Apache-2.0
// Coarse meshes with smooth normals: what they stand for is round.
#pragma once

#include "tests/scenes/artefact_scene.h"

namespace surimi::test {

/// A cylinder of this many sides before a monitor, alone. The round one is convex, so it is exactly lit wherever its
/// normal sees the monitor: every lit texel of its side is 1 within the error.
ArtefactScene smooth_cylinder(int sides);

/// The same of a ball of 20 * 4^subdivisions triangles.
ArtefactScene smooth_ball(int subdivisions);

/// A pipe of eight smooth sides that passes through a wall of 1 cm from a lit room into a dark one. What is behind the
/// wall is exactly dark, however far the round pipe stands out of the mesh.
ArtefactScene pipe_through_a_wall();

/// A smooth cylinder of eight sides that touches a wall along an edge, with the monitor behind the wall: exactly dark.
ArtefactScene cylinder_against_a_wall();

}  // namespace surimi::test
