// SPDX-License-Identifier: Apache-2.0
#include "runtime/compare/compare.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/compare/same_size.h"

namespace surimi {
namespace {

/// What one row adds. Rows are summed apart and then in order, so the result does not depend on the threads.
struct RowSums {
    double squared = 0, relative = 0, absolute = 0;
};

double largest_channel(const Vec3& v) {
    return std::max({v.x, v.y, v.z});
}

constexpr double left_out = -1;  // in place of a pixel's absolute difference

/// Sums over row y, and the largest channel's absolute difference of each of its pixels.
RowSums add_row(const Image<Vec3f>& image, const Image<Vec3f>& reference, int y, Image<double>& absolute) {
    RowSums sums;
    for (int x = 0; x < image.width; ++x) {
        const Vec3 a(image.at(x, y)), b(reference.at(x, y));
        if (!is_finite(a) || !is_finite(b)) {
            absolute.at(x, y) = left_out;
            continue;
        }
        const Vec3 error = a - b, squared = error * error, size = glm::abs(error);
        sums.squared += squared.x + squared.y + squared.z;
        sums.absolute += size.x + size.y + size.z;
        for (int c = 0; c < 3; ++c) sums.relative += squared[c] / (b[c] * b[c] + relative_epsilon);
        absolute.at(x, y) = largest_channel(size);
    }
    return sums;
}

}  // namespace

ImageDifference difference(const Image<Vec3f>& image, const Image<Vec3f>& reference) {
    require_same_size(image, reference);
    std::vector<RowSums> rows(static_cast<size_t>(image.height));
    Image<double> absolute(image.width, image.height);
    parallel_for(rows.size(), 16,
                 [&](size_t y) { rows[y] = add_row(image, reference, static_cast<int>(y), absolute); });

    ImageDifference result;
    std::vector<double>& pixels = absolute.pixels;
    const auto largest = std::max_element(pixels.begin(), pixels.end());
    if (largest == pixels.end() || *largest == left_out) {
        result.not_finite = pixels.size();
        return result;
    }
    const auto place = static_cast<int>(largest - pixels.begin());
    result.largest = *largest;
    result.largest_x = place % image.width;
    result.largest_y = place / image.width;

    const auto end = std::remove(pixels.begin(), pixels.end(), left_out);
    result.not_finite = static_cast<size_t>(pixels.end() - end);
    const auto count = static_cast<size_t>(end - pixels.begin());
    const auto rank = pixels.begin() + static_cast<std::ptrdiff_t>((99 * count + 99) / 100 - 1);
    std::nth_element(pixels.begin(), rank, end);
    result.p99 = *rank;

    RowSums sums;
    for (const RowSums& row : rows) {
        sums.squared += row.squared;
        sums.relative += row.relative;
        sums.absolute += row.absolute;
    }
    const double values = 3 * static_cast<double>(count);
    result.rmse = std::sqrt(sums.squared / values);
    result.relative_mse = sums.relative / values;
    result.mean_absolute = sums.absolute / values;
    return result;
}

Image<float> absolute_difference(const Image<Vec3f>& image, const Image<Vec3f>& reference) {
    require_same_size(image, reference);
    Image<float> result(image.width, image.height, std::numeric_limits<float>::quiet_NaN());
    for (size_t i = 0; i < result.pixels.size(); ++i) {
        const Vec3 a(image.pixels[i]), b(reference.pixels[i]);
        // Two floats of opposite sign may differ by more than a float holds.
        constexpr double most = std::numeric_limits<float>::max();
        if (is_finite(a) && is_finite(b))
            result.pixels[i] = static_cast<float>(std::min(largest_channel(glm::abs(a - b)), most));
    }
    return result;
}

double mean(const Image<float>& values) {
    double sum = 0;
    for (const float value : values.pixels) sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.pixels.size());
}

}  // namespace surimi
