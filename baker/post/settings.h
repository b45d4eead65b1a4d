// SPDX-License-Identifier: Apache-2.0
// What becomes of a map after its texels are measured.
#pragma once

namespace surimi {

struct PostSettings {
    bool fills_in_space = true;  ///< texels without a value take it from what is near them in the world
    bool stitches_seams = true;  ///< both sides of an edge that charts, surfaces or pages share are made to agree
};

}  // namespace surimi
