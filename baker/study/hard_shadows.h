// SPDX-License-Identifier: Apache-2.0
// The average of hard shadows of a grid of point lights on the monitor (Heckbert and Herf 1997).
#pragma once

#include "baker/study/receiver.h"

namespace surimi {

/// n x n lights in the middles of the monitor's cells, the same for all texels, each weighted by its irradiance without
/// shadow. Every light sees the texels at another place of their surface, the same for all of them, as accumulated
/// images are jittered (Haeberli and Akeley 1990); so the average is over the footprint. n >= 1. A shadow edge along
/// the grid crosses a row of lights at once: the error falls with n only, and shows as bands.
StudyEstimate hard_shadow_grid(const Receiver& receiver, int n);

}  // namespace surimi
