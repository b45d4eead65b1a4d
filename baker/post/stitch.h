// SPDX-License-Identifier: Apache-2.0
// Makes the two sides of seams agree, by the least change of texels.
#pragma once

#include <span>

#include "baker/post/channel.h"
#include "baker/post/seam_samples.h"
#include "baker/post/seams.h"

namespace surimi {

/// What stitching one monitor's maps did.
struct StitchReport {
    size_t pieces = 0;        ///< of seam
    double metres = 0;        ///< of seam
    size_t texels = 0;        ///< whose value changed
    double largest_move = 0;  ///< of a texel's visibility
    Jumps before;
    Jumps after;
};

/// Changes the visibility of one monitor, `pages[i]` being page i of the atlas, so that the bilinear lookups on both
/// sides of each seam agree, in the sense of least squares (M60) with all values in [0, 1] (M61). Texels move that a
/// lookup reads where the sides differ by more than the rounding of floats; all others keep their bits, as does an
/// `empty` texel. Measured texels resist, those whose value came from neighbours hardly do. Gutters must be filled
/// before, at least one texel wide. Linear in the length of seams but for the factors of sparse matrices; parallel;
/// the same bytes whatever the number of threads.
StitchReport stitch(const Atlas& atlas, const Seams& seams, std::span<Channel> pages);

}  // namespace surimi
