// SPDX-License-Identifier: Apache-2.0
// Which texels stitching may move, and the parts of them that can be solved on their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baker/post/channel.h"
#include "baker/post/seam_samples.h"
#include "baker/post/seams.h"

namespace surimi {

/// Texels that hang together by places of seams, and the pieces of seam that reach any of them.
struct StitchPart {
    std::vector<uint64_t> texels;  ///< as SeamSample counts them; increasing
    std::vector<uint32_t> pieces;  ///< indices into Seams::pieces; increasing
};

/// Steps between the places of a piece at which the sides are made to agree: at least 2 a texel of the finer side, and
/// both ends are places.
size_t steps_of(const SeamPiece& piece);

/// Calls visit(SeamSample, number of the place) for those places.
template <class Visit>
void for_each_place(const Atlas& atlas, const SeamPiece& piece, const Visit& visit) {
    const size_t steps = steps_of(piece);
    for (size_t i = 0; i <= steps; ++i)
        visit(seam_sample(atlas, piece, static_cast<double>(i) / static_cast<double>(steps)), i);
}

/// The texels that are not empty and that a lookup reads where the two sides differ by more than rounding; in parts
/// that share no place of a seam, in the order of their lowest texels. n log n, parallel.
std::vector<StitchPart> find_stitch_parts(const Atlas& atlas, const Seams& seams, std::span<const Channel> pages);

}  // namespace surimi
