// SPDX-License-Identifier: Apache-2.0
// Values whose bilinear reconstruction averages over each texel to what was measured there.
#pragma once

#include <cstddef>
#include <span>

#include "baker/gather/exposure.h"
#include "baker/gather/panel.h"
#include "baker/post/channel.h"
#include "baker/texel/texels.h"

namespace surimi {

/// What fitting came to. Means are over the measured texels, by area; those that read nothing that may change miss
/// nothing.
struct BilinearFit {
    size_t texels = 0;        ///< that changed
    double largest_move = 0;  ///< of a texel
    double rms_before = 0;    ///< of the reconstruction's average over a texel less what was measured
    double rms_after = 0;
    size_t rounds = 0;  ///< of descent, the most of a page

    /// Those of another page.
    void add(const BilinearFit& page);

    double area = 0;  ///< of the means, in texels
};

/// Changes the values of one page of the monitor with these panels, filled and with the first ring of the gutter, by
/// (M67). Measured texels (`covered`) of exactly 0 or 1 keep their bits, as do texels that no read over a measured one
/// meets and those whose change is below 2^-14. Of the others measured ones and those that took their value from around
/// them may change; states stay and values are in [0, 1]. Linear in the texels, parallel; the number of threads does
/// not show.
BilinearFit fit_bilinear(const Receivers& receivers, std::span<const Panel> panels, Channel& channel);

/// Bytes that fit_bilinear takes at most beside its arguments.
size_t bilinear_fit_bytes(const Texels& texels);

}  // namespace surimi
