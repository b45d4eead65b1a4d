// SPDX-License-Identifier: Apache-2.0
// How far an image is from a reference: errors of its numbers, and the difference that a person sees.
#pragma once

#include <cstdint>

#include "runtime/base/image.h"
#include "runtime/base/math.h"

namespace surimi {

/// Added to the squared reference in the relative error, so that black does not decide it: errors below a radiance of
/// about 0.1, a tenth of display white, count as absolute ones (M28).
inline constexpr double relative_epsilon = 0.01;

/// Pixels per degree of a 3840 pixels wide screen of 0.7 m seen from 0.7 m, the viewer of Andersson et al. 2020.
inline constexpr double default_pixels_per_degree = 67;

/// Errors of an image's numbers, in its own units, over the pixels where both images are finite. All 0 where there are
/// none.
struct ImageDifference {
    double rmse = 0;           ///< over pixels and channels
    double relative_mse = 0;   ///< mean of (a - b)^2 / (b^2 + relative_epsilon), b: the reference
    double mean_absolute = 0;  ///< over pixels and channels
    double largest = 0;        ///< largest absolute difference of a channel
    int largest_x = 0;         ///< its pixel, the first in reading order
    int largest_y = 0;
    double p50 = 0;  ///< half of the pixels differ by no more than this in any channel
    double p95 = 0;  ///< so do 95 %
    double p99 = 0;
    double p999 = 0;          ///< and 99.9 %
    Vec3 rmse_of_channel{0};  ///< over pixels
    size_t compared = 0;      ///< pixels that both images and the mask have
    size_t not_finite = 0;    ///< pixels left out because one of the two is not finite
};

/// Compares two linear images (M28) where `mask` is not 0; an empty mask: everywhere. Throws Error(usage) when sizes
/// differ.
ImageDifference difference(const Image<Vec3f>& image, const Image<Vec3f>& reference, const Image<uint8_t>& mask = {});

/// Absolute difference of each pixel, in its largest channel; NaN where one of the two is not finite. Throws
/// Error(usage) when their sizes differ.
Image<float> absolute_difference(const Image<Vec3f>& image, const Image<Vec3f>& reference);

/// Image less reference of each pixel, in the channel where the two differ most; NaN where one of the two is not
/// finite. Throws Error(usage) when their sizes differ.
Image<float> signed_difference(const Image<Vec3f>& image, const Image<Vec3f>& reference);

/// FLIP of Andersson et al. 2020 for each pixel, in [0, 1]: the difference that a person sees who flips between the two
/// (M28). Both are display-referred linear sRGB; they are clamped to [0, 1] and NaN is black, as a screen would show
/// them. Throws Error(usage) when the sizes differ or `pixels_per_degree` is not in [1, 10000].
Image<float> flip(const Image<Vec3f>& image, const Image<Vec3f>& reference,
                  double pixels_per_degree = default_pixels_per_degree);

/// Mean of the pixels where `mask` is not 0, of all where it is empty; 0 of none.
double mean(const Image<float>& values, const Image<uint8_t>& mask = {});

/// Shows values from `low` (black) over purple and orange to `high` (pale yellow), as sRGB codes. Lightness rises
/// steadily, so the order survives printing in grey and every colour blindness. What is outside is clamped; NaN, and
/// everything where `high` is not above `low`, is black.
Image<glm::u8vec3> heat_map(const Image<float>& values, double low, double high);

/// Shows values from -`most` (blue) over 0 (white) to `most` (orange), as sRGB codes; these two hues are told apart by
/// every colour blindness. What is outside is clamped; NaN, and everything where `most` is not above 0, is black.
Image<glm::u8vec3> signed_heat_map(const Image<float>& values, double most);

}  // namespace surimi
