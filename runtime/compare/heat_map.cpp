// SPDX-License-Identifier: Apache-2.0
#include "runtime/compare/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace surimi {
namespace {

/// Least-squares fit, of the sixth degree, to the 256 colours of magma (van der Walt and Smith 2015), lowest power
/// first. It stays within 0.024 of them, and CIE lightness rises everywhere.
constexpr std::array<std::array<double, 7>, 3> magma = {{{-0.002, 0.25, 8.346, -27.667, 52.171, -50.759, 18.664},
                                                         {-0.001, 0.694, -3.596, 14.254, -27.945, 29.054, -11.49},
                                                         {-0.01, 2.495, 0.329, -13.647, 12.881, 4.27, -5.571}}};

// Of Okabe and Ito's palette for all kinds of colour vision.
const Vec3 blue(0, 0.447, 0.698);
const Vec3 orange(0.835, 0.369, 0);

uint8_t code(const std::array<double, 7>& coefficients, double x) {
    double value = 0;
    for (size_t i = coefficients.size(); i-- > 0;) value = value * x + coefficients[i];
    return static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

Image<glm::u8vec3> heat_map(const Image<float>& values, double low, double high) {
    Image<glm::u8vec3> shown(values.width, values.height);
    std::transform(values.pixels.begin(), values.pixels.end(), shown.pixels.begin(), [&](float value) {
        const double above = static_cast<double>(value) - low;
        // The negated comparison sends NaN to 0; the smaller than the range first, since both may be infinite.
        const double x = !(above > 0) || !(high > low) ? 0 : above < high - low ? above / (high - low) : 1;
        return glm::u8vec3(code(magma[0], x), code(magma[1], x), code(magma[2], x));
    });
    return shown;
}

Image<glm::u8vec3> signed_heat_map(const Image<float>& values, double most) {
    Image<glm::u8vec3> shown(values.width, values.height);
    std::transform(values.pixels.begin(), values.pixels.end(), shown.pixels.begin(), [&](float value) {
        if (std::isnan(value) || !(most > 0)) return glm::u8vec3(0);
        // Divided before it is clamped: both may be infinite.
        const double share = static_cast<double>(value) / most;
        const double x =
            std::isnan(share) ? std::copysign(1.0, static_cast<double>(value)) : std::clamp(share, -1.0, 1.0);
        const Vec3 color = glm::mix(Vec3(1), x < 0 ? blue : orange, std::abs(x));
        return glm::u8vec3(glm::round(255.0 * color));
    });
    return shown;
}

}  // namespace surimi
