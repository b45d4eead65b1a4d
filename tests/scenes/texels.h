// SPDX-License-Identifier: Apache-2.0
// Texels that are odd: slivers, two triangles in one, one at the origin, black ones that are valid.
#pragma once

#include "tests/scenes/artefact_scene.h"

namespace surimi::test {

/// A fan of needles, each narrower than a texel, and a plate of them in one plane, with nothing in the way: every
/// measured texel is exactly 1.
ArtefactScene sliver_charts();

inline constexpr int odd_texel_map = 32;  ///< texels a side that the UVs of the scenes below are made for

/// Two triangles that lie on one chart and share a column of texels at half its width, in one plane; a wall along their
/// common edge hides the monitor from the second. Texels of the column have E-weighted averages of 1 and 0.
ArtefactScene texels_with_two_shadows();

/// The same without the wall, the second triangle folded down by 60 degrees: both see all of the monitor that is above
/// their horizons and the other's, exactly what the surface under each texel sees.
ArtefactScene texels_with_two_normals();

/// A floor of 4 m with an odd number of texels a side about the origin, so that one has its centre at (0, 0, 0), in a
/// penumbra. That texel is measured like any other.
ArtefactScene texel_at_the_origin();

/// A floor whose texels before the monitor are hidden from it and whose others are behind it, unlit: all that is
/// measured is exactly 0, which is a value, and what has none takes it from there.
ArtefactScene black_beside_unlit();

}  // namespace surimi::test
