// SPDX-License-Identifier: Apache-2.0
// What the bilinear reads over a texel's surface average to.
#pragma once

#include <array>
#include <span>

#include "baker/gather/exposure.h"
#include "baker/gather/panel.h"
#include "baker/texel/texels.h"

namespace surimi {

/// Weights of the 3 x 3 texels around a texel, row by row, at least 0 (M67).
struct ReadAverage {
    std::array<float, 9> weights{};  ///< sum to 1; all 0 where the texel is only touched
    float area = 0;                  ///< share of the texel's square that is covered and not inside, at most 1
};

/// Of a texel that triangles cover wholly, none of it inside other geometry, and that does not lie at the map's end.
inline constexpr ReadAverage read_average_of_whole{
    {1 / 64.f, 6 / 64.f, 1 / 64.f, 6 / 64.f, 36 / 64.f, 6 / 64.f, 1 / 64.f, 6 / 64.f, 1 / 64.f}, 1};

/// Is read_average_of_whole that of this texel, to a thousandth of its square?
bool is_read_as_whole(const Receivers& receivers, const Texel& texel);

/// Of what was measured: the part that triangles cover, without what is inside other geometry (M65). Reads beyond the
/// map are those of its border, as a sampler that clamps has them, so that texels outside the map have no weight.
ReadAverage read_average(const Receivers& receivers, std::span<const Panel> panels, const Texel& texel);

}  // namespace surimi
