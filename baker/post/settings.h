// SPDX-License-Identifier: Apache-2.0
// What becomes of a map after its texels are measured.
#pragma once

namespace surimi {

/// What the values of texels stand for.
enum class Fit {
    none,      ///< what was measured on average over the texel
    bilinear,  ///< such that bilinear reads average to it
};

struct PostSettings {
    bool fills_in_space = true;  ///< texels without a value take it from what is near them in the world
    int inside_rings = 1;        ///< of texels inside other geometry beside covered ones that take values from around
                                 ///< them, as bilinear reads meet them; deeper ones stay at 0, which they are
    bool stitches_seams = true;  ///< both sides of an edge that charts, surfaces or pages share are made to agree
    Fit fit = Fit::none;
};

}  // namespace surimi
