// SPDX-License-Identifier: Apache-2.0
// Numbers as the bytes of a picture, from which the page gets them back. 0 is always "no value".
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace surimi {

/// Logarithmic codes tell values apart that differ by a fourth of an octave, 9 % up or down: finer ones would be noise,
/// and noise does not compress.
inline constexpr int steps_per_octave = 4;
/// Errors are told apart from 2^-error_octaves up to 1.
inline constexpr int error_octaves = 16;
/// Signed differences likewise, from 2^-difference_octaves up to 1.
inline constexpr int difference_octaves = 12;

/// Steps from 2^-octaves up to `magnitude`, at most those to 1; -1: it lies below.
inline int log_step(double magnitude, int octaves) {
    const double place = magnitude > 0 ? std::log2(magnitude) + octaves : -1;
    return place < 0 ? -1 : static_cast<int>(std::lround(steps_per_octave * std::min<double>(place, octaves)));
}

/// 1: below 2^-error_octaves; 2 and more: steps from there.
inline uint8_t error_code(double error) {
    return static_cast<uint8_t>(2 + log_step(error, error_octaves));
}

/// 128: nearer to 0 than 2^-difference_octaves; 129 and more: steps above; 127 and less: steps below.
inline uint8_t difference_code(double difference) {
    const int step = 1 + log_step(std::abs(difference), difference_octaves);
    return static_cast<uint8_t>(difference < 0 ? 128 - step : 128 + step);
}

/// 1 to 255 for `low` to `high`, linear; what is outside gets the nearer end, NaN the low one.
inline uint8_t linear_code(double value, double low, double high) {
    const double place = high > low ? (value - low) / (high - low) : 0;
    return static_cast<uint8_t>(1 + std::lround(254 * (place > 0 ? std::min(place, 1.0) : 0)));
}

}  // namespace surimi
