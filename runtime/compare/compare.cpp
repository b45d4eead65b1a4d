// SPDX-License-Identifier: Apache-2.0
#include "runtime/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/compare/same_size.h"

namespace surimi {
namespace {

/// What one row adds. Rows are summed apart and then in order, so the result does not depend on the threads.
struct RowSums {
    Vec3 squared{0};
    double relative = 0, absolute = 0;
    size_t not_finite = 0;
};

double largest_channel(const Vec3& v) {
    return std::max({v.x, v.y, v.z});
}

constexpr double left_out = -1;  // in place of a pixel's absolute difference

/// Sums over row y, and the largest channel's absolute difference of each of its pixels that is not left out before.
RowSums add_row(const Image<Vec3f>& image, const Image<Vec3f>& reference, int y, Image<double>& absolute) {
    RowSums sums;
    for (int x = 0; x < image.width; ++x) {
        if (absolute.at(x, y) == left_out) continue;
        const Vec3 a(image.at(x, y)), b(reference.at(x, y));
        if (!is_finite(a) || !is_finite(b)) {
            absolute.at(x, y) = left_out;
            ++sums.not_finite;
            continue;
        }
        const Vec3 error = a - b, squared = error * error, size = glm::abs(error);
        sums.squared += squared;
        sums.absolute += size.x + size.y + size.z;
        for (int c = 0; c < 3; ++c) sums.relative += squared[c] / (b[c] * b[c] + relative_epsilon);
        absolute.at(x, y) = largest_channel(size);
    }
    return sums;
}

/// What `share` of the first `count` values do not exceed; puts them in another order.
double percentile(std::vector<double>& values, size_t count, double share) {
    const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(count)));
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::max<size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), place, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *place;
}

/// Image less reference in the channel where they differ most, as far as a float holds it; NaN: not finite.
float farthest_channel(const Vec3f& image, const Vec3f& reference) {
    const Vec3 a(image), b(reference), error = a - b;
    if (!is_finite(a) || !is_finite(b)) return std::numeric_limits<float>::quiet_NaN();
    int c = 0;
    for (int other = 1; other < 3; ++other)
        if (std::abs(error[other]) > std::abs(error[c])) c = other;
    // Two floats of opposite sign may differ by more than a float holds.
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(error[c], -most, most));
}

}  // namespace

ImageDifference difference(const Image<Vec3f>& image, const Image<Vec3f>& reference, const Image<uint8_t>& mask) {
    require_same_size(image, reference);
    Image<double> absolute(image.width, image.height);
    if (!mask.empty()) {
        require_same_size(image, mask);
        std::transform(mask.pixels.begin(), mask.pixels.end(), absolute.pixels.begin(),
                       [](uint8_t is_compared) { return is_compared ? 0 : left_out; });
    }
    std::vector<RowSums> rows(static_cast<size_t>(image.height));
    parallel_for(rows.size(), 16,
                 [&](size_t y) { rows[y] = add_row(image, reference, static_cast<int>(y), absolute); });
    RowSums sums;
    for (const RowSums& row : rows) {
        sums.squared += row.squared;
        sums.relative += row.relative;
        sums.absolute += row.absolute;
        sums.not_finite += row.not_finite;
    }

    ImageDifference result;
    result.not_finite = sums.not_finite;
    std::vector<double>& pixels = absolute.pixels;
    const auto largest = std::max_element(pixels.begin(), pixels.end());
    if (largest == pixels.end() || *largest == left_out) return result;
    const auto place = static_cast<int>(largest - pixels.begin());
    result.largest = *largest;
    result.largest_x = place % image.width;
    result.largest_y = place / image.width;

    result.compared = static_cast<size_t>(std::remove(pixels.begin(), pixels.end(), left_out) - pixels.begin());
    result.p50 = percentile(pixels, result.compared, 0.5);
    result.p95 = percentile(pixels, result.compared, 0.95);
    result.p99 = percentile(pixels, result.compared, 0.99);
    result.p999 = percentile(pixels, result.compared, 0.999);
    const auto count = static_cast<double>(result.compared);
    result.rmse_of_channel = glm::sqrt(sums.squared / count);
    result.rmse = std::sqrt((sums.squared.x + sums.squared.y + sums.squared.z) / (3 * count));
    result.relative_mse = sums.relative / (3 * count);
    result.mean_absolute = sums.absolute / (3 * count);
    return result;
}

Image<float> signed_difference(const Image<Vec3f>& image, const Image<Vec3f>& reference) {
    require_same_size(image, reference);
    Image<float> result(image.width, image.height);
    std::transform(image.pixels.begin(), image.pixels.end(), reference.pixels.begin(), result.pixels.begin(),
                   farthest_channel);
    return result;
}

Image<float> absolute_difference(const Image<Vec3f>& image, const Image<Vec3f>& reference) {
    Image<float> result = signed_difference(image, reference);
    for (float& value : result.pixels) value = std::abs(value);
    return result;
}

double mean(const Image<float>& values, const Image<uint8_t>& mask) {
    if (!mask.empty()) require_same_size(values, mask);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < values.pixels.size(); ++i) {
        if (!mask.empty() && !mask.pixels[i]) continue;
        sum += static_cast<double>(values.pixels[i]);
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace surimi
