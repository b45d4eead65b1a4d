// SPDX-License-Identifier: Apache-2.0
// Bilinear lookup in an image of linear colours.
#pragma once

#include <algorithm>

#include "runtime/base/image.h"
#include "runtime/base/math.h"

namespace surimi {

/// Colour at uv in [0, 1]^2, v down, texel centres at half texels; clamped at the border; NaN reads as 0. The image
/// must not be empty.
inline Vec3 look_up_bilinear(const Image<Vec3f>& image, const Vec2& uv) {
    // The negated comparison sends NaN to 0.
    const auto position = [](double u, int size) {
        const double x = u * size - 0.5;
        return !(x > 0) ? 0.0 : std::min(x, static_cast<double>(size - 1));
    };
    const double x = position(uv.x, image.width), y = position(uv.y, image.height);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
    const Vec3 top = glm::mix(Vec3(image.at(x0, y0)), Vec3(image.at(x1, y0)), x - x0);
    const Vec3 bottom = glm::mix(Vec3(image.at(x0, y1)), Vec3(image.at(x1, y1)), x - x0);
    return glm::mix(top, bottom, y - y0);
}

}  // namespace surimi
