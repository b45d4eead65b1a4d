// SPDX-License-Identifier: Apache-2.0
// The visibility that a study measures against: very many rays, and how far off they may be.
#pragma once

#include "baker/study/receiver.h"

namespace surimi {

struct Reference {
    double visibility = 0;
    double error = 0;  ///< standard error
    bool is_lit = false;
};

/// `rays` (at least 4) rounded down to four times a square: four independent jittered sets of n x n cells of texel and
/// monitor, paired at random, so that their spread states the standard error without bias (M58). The monitor is sampled
/// by solid angle: evenly by area, texels close to it would need a hundred times the rays. The random numbers are a
/// generator's of its own (PCG32, O'Neill 2014); nothing but the rays is shared with the estimators that it judges.
Reference reference_visibility(const Receiver& receiver, size_t rays);

}  // namespace surimi
