// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/display.h"

#include <algorithm>

#include "runtime/base/color.h"
#include "runtime/preview/see.h"

namespace surimi {

double filmic(double x) {
    if (!(x > 0)) return 0;
    x = std::min(x, 1e6);  // beyond, the quotient is 1 to rounding
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

double automatic_exposure(const Picture& picture) {
    return picture.bright_level > 0 && std::isfinite(picture.bright_level) ? 0.7 / picture.bright_level : 1;
}

Image<Vec3f> displayed(const Image<Vec3f>& pixels, Show show, double exposure) {
    Image<Vec3f> result(pixels.width, pixels.height);
    std::transform(pixels.pixels.begin(), pixels.pixels.end(), result.pixels.begin(), [&](const Vec3f& p) {
        Vec3f shown;
        for (int c = 0; c < 3; ++c) {
            const auto x = static_cast<double>(p[c]);
            shown[c] = static_cast<float>(is_lit_view(show) ? filmic(x * exposure) : x > 0 ? std::min(x, 1.0) : 0.0);
        }
        return shown;
    });
    return result;
}

Image<glm::u8vec3> to_codes(const Image<Vec3f>& displayed) {
    Image<glm::u8vec3> codes(displayed.width, displayed.height);
    std::transform(displayed.pixels.begin(), displayed.pixels.end(), codes.pixels.begin(),
                   [](const Vec3f& p) { return srgb8(Vec3(p)); });
    return codes;
}

}  // namespace surimi
