// SPDX-License-Identifier: Apache-2.0
// One plane under a soft shadow, whole and cut in every way that a map can be cut.
#pragma once

#include "tests/scenes/artefact_scene.h"

namespace surimi::test {

/// Where the plane's two parts are kept apart.
enum class Cut {
    nowhere,   ///< one quad
    charts,    ///< two charts of one surface
    surfaces,  ///< two objects
    pages      ///< two objects without UVs of their own, to be spread over two atlases
};

/// Where two parts meet.
struct Joint {
    Vec3 from{0}, to{0};
    Vec3 across{1, 0, 0};  ///< unit, in the surfaces' plane, from the first part to the second
};

struct CutPlane : ArtefactScene {
    Joint joint;
};

inline constexpr int cut_plane_map = 128;  ///< texels a side that its UVs are made for

/// A floor of 4 x 2 m at 16 texels a metre, cut at x = 0.13, the parts turned against each other on the map; the
/// penumbra of a sheet lies across the joint. Bilinear reads from both sides of the joint differ by 1/255 at most, and
/// texels that no read at the joint touches keep their measured values bit for bit.
CutPlane cut_plane(Cut cut);

/// A box under the same light, whose faces meet at right angles: nothing of it is to be stitched.
ArtefactScene box_with_hard_edges();

}  // namespace surimi::test
