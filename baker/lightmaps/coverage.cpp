// SPDX-License-Identifier: Apache-2.0
#include "baker/lightmaps/coverage.h"

#include <algorithm>
#include <cmath>

#include "baker/post/growth.h"

namespace surimi {
namespace {

bool differs(const Image<float>& image) {
    return std::any_of(image.pixels.begin(), image.pixels.end(),
                       [&](float a) { return (a > 0.5F) != (image.pixels.front() > 0.5F); });
}

std::vector<uint8_t> above_half(const Image<float>& image) {
    std::vector<uint8_t> covered(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), covered.begin(),
                   [](float value) { return static_cast<uint8_t>(value > 0.5F); });
    return covered;
}

std::vector<uint8_t> covered_by_light(std::span<const LightPair> pairs, double threshold) {
    std::vector<uint8_t> covered(pairs.front().unshadowed.light.pixels.size(), 0);
    for (const LightPair& pair : pairs) {
        const auto& light = pair.unshadowed.light.pixels;
        const double least = threshold * top_of(pair.unshadowed.light);
        for (size_t i = 0; i < light.size(); ++i)
            if (std::isfinite(light[i]) && light[i] > least) covered[i] = 1;
    }
    return covered;
}

/// Numbers what hangs together by sides, by a flood from each texel that has no number yet.
void number_islands(const std::vector<uint8_t>& covered, int width, Coverage& coverage) {
    const auto w = static_cast<size_t>(width);
    std::vector<size_t> open;
    const auto reach = [&](size_t i) {
        if (!covered[i] || coverage.island[i] != no_chart) return;
        coverage.island[i] = coverage.islands;
        open.push_back(i);
        ++coverage.texels;
    };
    for (size_t start = 0; start < covered.size(); ++start) {
        reach(start);
        if (open.empty()) continue;
        while (!open.empty()) {
            const size_t i = open.back();
            open.pop_back();
            if (i % w > 0) reach(i - 1);
            if (i % w + 1 < w) reach(i + 1);
            if (i >= w) reach(i - w);
            if (i + w < covered.size()) reach(i + w);
        }
        ++coverage.islands;
    }
}

}  // namespace

double top_of(const Image<float>& light) {
    std::vector<float> lit;
    std::copy_if(light.pixels.begin(), light.pixels.end(), std::back_inserter(lit),
                 [](float value) { return std::isfinite(value) && value > 0; });
    if (lit.empty()) return 0;
    const auto place = lit.begin() + static_cast<std::ptrdiff_t>((lit.size() - 1) - (lit.size() - 1) / 1000);
    std::nth_element(lit.begin(), place, lit.end());
    return static_cast<double>(*place);
}

Coverage find_coverage(std::span<const LightPair> pairs, const Image<uint8_t>& mask, double threshold) {
    Coverage coverage;
    std::vector<uint8_t> covered;
    const auto with_alpha = std::find_if(pairs.begin(), pairs.end(), [](const LightPair& pair) {
        return !pair.unshadowed.alpha.empty() && differs(pair.unshadowed.alpha);
    });
    if (!mask.empty()) {
        coverage.source = CoverageSource::mask;
        covered = mask.pixels;
    } else if (with_alpha != pairs.end()) {
        coverage.source = CoverageSource::alpha;
        covered = above_half(with_alpha->unshadowed.alpha);
    } else {
        covered = covered_by_light(pairs, threshold);
    }
    coverage.island.assign(covered.size(), no_chart);
    number_islands(covered, pairs.front().unshadowed.light.width, coverage);
    return coverage;
}

}  // namespace surimi
