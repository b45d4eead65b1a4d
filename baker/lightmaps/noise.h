// SPDX-License-Identifier: Apache-2.0
// How noisy a lightmap is, told from itself.
#pragma once

#include "baker/lightmaps/coverage.h"
#include "baker/lightmaps/lightmap.h"

namespace surimi {

/// The standard deviation of the noise at each texel (M68): the median of the second differences of 5 x 5 texels along
/// rows and along columns, their geometric mean, and the rounding of the file. Only texels of one island are compared;
/// where fewer than four differences can be taken it is the rounding alone. 0 outside. Light without shadows is smooth;
/// shadows would count as noise. Parallel.
Image<float> noise_of(const Lightmap& lightmap, const Coverage& coverage);

}  // namespace surimi
