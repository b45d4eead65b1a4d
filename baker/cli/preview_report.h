// SPDX-License-Identifier: Apache-2.0
// What `surimi preview` says about a picture: what was computed for it, and how far it is from the truth.
#pragma once

#include <string>
#include <vector>

#include "runtime/compare/compare.h"
#include "runtime/preview/render.h"

namespace surimi {

/// What the scene called for and what not, with counts, as text (--explain).
std::string explanation(const Lighting& lighting, const Picture& picture);

/// Differences of the pixels whose roughness lies in [low, high).
struct RoughnessBand {
    double low = 0, high = 1;
    size_t pixels = 0;
    ImageDifference difference;
};

/// A picture against a brute-force one of the same view. Numbers are in units of the exposed picture, in which bright
/// surfaces are 0.7.
struct Comparison {
    Image<Vec3f> reference;  ///< mean of its two halves, nits
    ImageDifference all;
    double noise = 0;  ///< root mean square error of the reference itself, from its two halves
    double flip = 0;   ///< mean, of what a screen shows
    std::vector<RoughnessBand> bands;
};

/// `halves` are two independent references of the same view; `exposed` scales nits to the units above.
Comparison compare_pictures(const Picture& picture, const std::vector<Image<Vec3f>>& halves, double exposure);

std::string as_text(const Comparison& comparison);
std::string as_json(const Comparison& comparison);

}  // namespace surimi
