// SPDX-License-Identifier: Apache-2.0
// Linear light and the codes that stand for it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "runtime/base/math.h"

namespace surimi {

/// sRGB transfer function (IEC 61966-2-1); clamps to [0, 1]; NaN becomes 0.
inline double srgb_from_linear(double linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Its inverse; clamps to [0, 1]; NaN becomes 0.
inline double linear_from_srgb(double encoded) {
    if (!(encoded > 0)) return 0;
    if (encoded >= 1) return 1;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Nearest 8-bit sRGB code of a linear colour.
inline glm::u8vec3 srgb8(const Vec3& linear) {
    const auto code = [](double x) { return static_cast<uint8_t>(std::lround(255 * srgb_from_linear(x))); };
    return {code(linear.x), code(linear.y), code(linear.z)};
}

}  // namespace surimi
