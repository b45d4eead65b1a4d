// SPDX-License-Identifier: Apache-2.0
#include "baker/lightmaps/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "baker/post/growth.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr int window = 2;  // texels on each side: 5 x 5
constexpr size_t fewest_differences = 4;
// Of normal numbers: |x| has the median 0.6745 sigma, and a - 2 b + c the variance 6 sigma^2.
const double deviation_of_median = 1 / (0.6744897501960817 * std::sqrt(6.0));
constexpr float no_difference = -1;

/// |a - 2 b + c| of the texel and its neighbours before and after it, `stride` texels apart.
float second_difference(const std::vector<float>& light, const Coverage& coverage, size_t i, size_t stride) {
    const uint32_t island = coverage.island[i];
    if (island == no_chart || coverage.island[i - stride] != island || coverage.island[i + stride] != island)
        return no_difference;
    const double difference = static_cast<double>(light[i - stride]) - 2 * static_cast<double>(light[i]) +
                              static_cast<double>(light[i + stride]);
    return std::isfinite(difference) ? static_cast<float>(std::abs(difference)) : no_difference;
}

/// Along rows and along columns, by texel.
std::array<std::vector<float>, 2> second_differences(const Image<float>& light, const Coverage& coverage) {
    const auto w = static_cast<size_t>(light.width), h = static_cast<size_t>(light.height);
    std::array<std::vector<float>, 2> differences;
    for (auto& along : differences) along.assign(w * h, no_difference);
    parallel_for(h, 16, [&](size_t y) {
        for (size_t x = 0, i = y * w; x < w; ++x, ++i) {
            if (x > 0 && x + 1 < w) differences[0][i] = second_difference(light.pixels, coverage, i, 1);
            if (y > 0 && y + 1 < h) differences[1][i] = second_difference(light.pixels, coverage, i, w);
        }
    });
    return differences;
}

/// The median of what there is of the differences within the window; 0 where that is too little.
double median_near(const std::vector<float>& differences, const Image<float>& image, int x, int y) {
    std::array<float, (2 * window + 1) * (2 * window + 1)> near{};
    size_t count = 0;
    for (int v = std::max(0, y - window); v <= std::min(image.height - 1, y + window); ++v)
        for (int u = std::max(0, x - window); u <= std::min(image.width - 1, x + window); ++u)
            if (const float d = differences[image.index(u, v)]; d >= 0) near[count++] = d;
    if (count < fewest_differences) return 0;
    const auto middle = near.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(near.begin(), middle, near.begin() + static_cast<std::ptrdiff_t>(count));
    return static_cast<double>(*middle);
}

}  // namespace

Image<float> noise_of(const Lightmap& lightmap, const Coverage& coverage) {
    const Image<float>& light = lightmap.light;
    const auto differences = second_differences(light, coverage);
    Image<float> noise(light.width, light.height);
    const auto at = [&](int x, int y) {
        const size_t i = light.index(x, y);
        if (coverage.island[i] == no_chart) return 0.0;
        const double spread =
            std::sqrt(median_near(differences[0], light, x, y) * median_near(differences[1], light, x, y));
        const double value = static_cast<double>(light.pixels[i]);
        const double rounding = std::isfinite(value) ? step_at(lightmap, value) / std::sqrt(12.0) : 0;
        return std::hypot(spread * deviation_of_median, rounding);
    };
    parallel_for(static_cast<size_t>(light.height), 8, [&](size_t y) {
        for (int x = 0; x < light.width; ++x)
            noise.at(x, static_cast<int>(y)) = static_cast<float>(at(x, static_cast<int>(y)));
    });
    return noise;
}

}  // namespace surimi
