// SPDX-License-Identifier: Apache-2.0
// Places along seams, and what the two sides of the map say there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "baker/post/channel.h"
#include "baker/post/seams.h"

namespace surimi {

/// One place of a seam: the value on one side less that on the other is the sum of weights times texels.
struct SeamSample {
    std::array<uint64_t, 8> texels{};  ///< page * width * height + index in the page; each once
    std::array<double, 8> weights{};   ///< of the bilinear lookup; of the second side negative; none is 0
    size_t count = 0;                  ///< of texels, at most 8
};

/// The place at the share `share` of a piece, as the runtime's bilinear lookup sees it.
SeamSample seam_sample(const Atlas& atlas, const SeamPiece& piece, double share);

/// The texels along the finer side of a piece; the steps between samples are counted in these.
double texels_along(const SeamPiece& piece);

/// The visibility of one texel, by its number.
inline double visibility_of(std::span<const Channel> pages, uint64_t texel) {
    const size_t size = pages[0].visibility.pixels.size();
    return static_cast<double>(pages[texel / size].visibility.pixels[texel % size]);
}

/// What that texel is.
inline TexelState state_of(std::span<const Channel> pages, uint64_t texel) {
    const size_t size = pages[0].state.pixels.size();
    return pages[texel / size].state.pixels[texel % size];
}

/// By how much the sides differ, with sign.
double jump(std::span<const Channel> pages, const SeamSample& sample);

/// False where half of what one side reads is inside other geometry: what stands on the seam hides it, and the sides
/// need not agree.
bool is_seen(std::span<const Channel> pages, const SeamSample& sample);

/// How far the two sides of seams are apart, over places weighed by the length of seam that they stand for.
struct Jumps {
    double largest = 0;
    double percentile_99 = 0;
};

/// Of one monitor on all pages where seams can be seen, at about 7 places a texel: denser than those at which `stitch`
/// makes the sides agree, and mostly between them.
Jumps measure_jumps(const Atlas& atlas, const Seams& seams, std::span<const Channel> pages);

}  // namespace surimi
