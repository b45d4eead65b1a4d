// SPDX-License-Identifier: Apache-2.0
// Numbers as the bytes of a picture, from which the page gets them back. 0 is always "no value".
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace surimi {

/// Errors are coded by their logarithm, from 2^-error_octaves up to 1.
inline constexpr int error_octaves = 16;
/// Signed differences likewise, from 2^-difference_octaves up to 1, on both sides of 128.
inline constexpr int difference_octaves = 14;

/// Where `magnitude` lies between 2^-octaves (0) and 1 (1), in the logarithm; below 0 what is smaller.
inline double log_place(double magnitude, int octaves) {
    return magnitude > 0 ? std::min(1.0, 1 + std::log2(magnitude) / octaves) : -1;
}

/// 1: below 2^-error_octaves; 2 to 255: that to 1.
inline uint8_t error_code(double error) {
    const double place = log_place(error, error_octaves);
    return place < 0 ? 1 : static_cast<uint8_t>(2 + std::lround(253 * place));
}

/// 128: nearer than 2^-difference_octaves to 0; 129 to 255 above, 127 to 1 below.
inline uint8_t difference_code(double difference) {
    const double place = log_place(std::abs(difference), difference_octaves);
    if (place < 0) return 128;
    const long step = 1 + std::lround(126 * place);
    return static_cast<uint8_t>(difference < 0 ? 128 - step : 128 + step);
}

/// 1 to 255 for `low` to `high`, linear; what is outside gets the nearer end, NaN the low one.
inline uint8_t linear_code(double value, double low, double high) {
    const double place = high > low ? (value - low) / (high - low) : 0;
    return static_cast<uint8_t>(1 + std::lround(254 * (place > 0 ? std::min(place, 1.0) : 0)));
}

}  // namespace surimi
