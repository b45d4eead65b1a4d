// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/display.h"

#include <algorithm>
#include <array>
#include <bit>

#include "runtime/base/color.h"
#include "runtime/preview/see.h"

namespace surimi {
namespace {

float shown(float value, Show show, double exposure) {
    const auto x = static_cast<double>(value);
    return static_cast<float>(is_lit_view(show) ? filmic(x * exposure) : x > 0 ? std::min(x, 1.0) : 0.0);
}

uint8_t code_by_power(float x) {
    return srgb8(Vec3(static_cast<double>(x))).x;
}

/// The codes of all floats in [0, 1] without a power: a guess that is at most one code low, and where the next begins.
struct CodeTable {
    static constexpr int cells = 4096;  // each less than a code wide: the curve's steepest part has 3295 codes a unit
    std::array<uint8_t, cells + 1> first{};  // code of the least value of a cell
    std::array<float, 257> begin{};          // least float that has a code
    CodeTable() {
        for (int i = 0; i <= cells; ++i)
            first[static_cast<size_t>(i)] = code_by_power(static_cast<float>(i) / static_cast<float>(cells));
        begin[256] = INFINITY;
        for (size_t code = 1; code < 256; ++code) {
            uint32_t low = 0, high = std::bit_cast<uint32_t>(1.0f);  // the bits of floats above 0 are in their order
            while (high - low > 1) {
                const uint32_t middle = low + (high - low) / 2;
                (code_by_power(std::bit_cast<float>(middle)) >= code ? high : low) = middle;
            }
            begin[code] = std::bit_cast<float>(high);
        }
    }
    uint8_t of(float x) const {
        if (!(x > 0)) return 0;
        if (x >= 1) return 255;
        const uint8_t guess = first[static_cast<size_t>(x * static_cast<float>(cells))];
        return x >= begin[guess + 1u] ? static_cast<uint8_t>(guess + 1) : guess;
    }
};

glm::u8vec3 codes_of_displayed(const Vec3f& p) {
    static const CodeTable table;
    return {table.of(p.x), table.of(p.y), table.of(p.z)};
}

}  // namespace

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
        return Vec3f(shown(p.x, show, exposure), shown(p.y, show, exposure), shown(p.z, show, exposure));
    });
    return result;
}

glm::u8vec3 codes_of(const Vec3f& pixel, Show show, double exposure) {
    return codes_of_displayed(
        {shown(pixel.x, show, exposure), shown(pixel.y, show, exposure), shown(pixel.z, show, exposure)});
}

Image<glm::u8vec3> to_codes(const Image<Vec3f>& displayed) {
    Image<glm::u8vec3> codes(displayed.width, displayed.height);
    std::transform(displayed.pixels.begin(), displayed.pixels.end(), codes.pixels.begin(), codes_of_displayed);
    return codes;
}

}  // namespace surimi
