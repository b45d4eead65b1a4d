// SPDX-License-Identifier: Apache-2.0
#include "baker/post/seam_samples.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

void add(SeamSample& sample, uint64_t texel, double weight) {
    if (weight == 0) return;
    for (size_t i = 0; i < sample.count; ++i) {
        if (sample.texels[i] != texel) continue;
        sample.weights[i] += weight;
        return;
    }
    sample.texels[sample.count] = texel;
    sample.weights[sample.count++] = weight;
}

/// The four texels of the lookup at a place in texels, clamped at the border of the page.
void add_lookup(SeamSample& sample, const Atlas& atlas, const Vec2& place, int page, double sign) {
    const double x = std::clamp(place.x - 0.5, 0.0, atlas.width - 1.0);
    const double y = std::clamp(place.y - 0.5, 0.0, atlas.height - 1.0);
    const auto x0 = static_cast<uint64_t>(x), y0 = static_cast<uint64_t>(y);
    const double right = x - static_cast<double>(x0), below = y - static_cast<double>(y0);
    const auto width = static_cast<uint64_t>(atlas.width);
    const uint64_t first = (static_cast<uint64_t>(page) * static_cast<uint64_t>(atlas.height) + y0) * width + x0;
    add(sample, first, sign * (1 - right) * (1 - below));  // what would lie beyond the border has no weight
    add(sample, first + 1, sign * right * (1 - below));
    add(sample, first + width, sign * (1 - right) * below);
    add(sample, first + width + 1, sign * right * below);
}

struct Measured {
    float jump = 0;
    float length = 0;
};

}  // namespace

SeamSample seam_sample(const Atlas& atlas, const SeamPiece& piece, double share) {
    SeamSample sample;
    double sign = 1;
    for (const SeamSide& side : piece.sides) {
        add_lookup(sample, atlas, glm::mix(side.texels[0], side.texels[1], share), side.page, sign);
        sign = -1;
    }
    size_t kept = 0;
    for (size_t i = 0; i < sample.count; ++i) {  // a texel that both sides see alike
        if (sample.weights[i] == 0) continue;
        sample.texels[kept] = sample.texels[i];
        sample.weights[kept++] = sample.weights[i];
    }
    sample.count = kept;
    return sample;
}

double texels_along(const SeamPiece& piece) {
    double longest = 0;
    for (const SeamSide& side : piece.sides) longest = std::max(longest, glm::length(side.texels[1] - side.texels[0]));
    return longest;
}

double jump(std::span<const Channel> pages, const SeamSample& sample) {
    double difference = 0;
    for (size_t i = 0; i < sample.count; ++i) difference += sample.weights[i] * visibility_of(pages, sample.texels[i]);
    return difference;
}

bool is_seen(std::span<const Channel> pages, const SeamSample& sample) {
    std::array<double, 2> inside{};  // of the first side and of the second
    for (size_t i = 0; i < sample.count; ++i)
        if (state_of(pages, sample.texels[i]) == TexelState::inside)
            inside[sample.weights[i] > 0 ? 0 : 1] += std::abs(sample.weights[i]);
    return std::max(inside[0], inside[1]) < 0.5;
}

Jumps measure_jumps(const Atlas& atlas, const Seams& seams, std::span<const Channel> pages) {
    constexpr double places_a_texel = 7;  // no multiple of the 2 of the solver
    const size_t count = seams.pieces.size();
    constexpr size_t grain = 1024;
    std::vector<std::vector<Measured>> found((count + grain - 1) / grain);
    parallel_ranges(count, grain, [&](size_t begin, size_t end) {
        for (size_t p = begin; p < end; ++p) {
            const SeamPiece& piece = seams.pieces[p];
            const double places = std::max(1.0, std::ceil(places_a_texel * texels_along(piece)));
            for (double i = 0; i < places; ++i) {
                const SeamSample sample = seam_sample(atlas, piece, (i + 0.5) / places);
                if (!is_seen(pages, sample)) continue;
                const double difference = jump(pages, sample);
                found[begin / grain].push_back(
                    {static_cast<float>(std::abs(difference)), static_cast<float>(piece.length / places)});
            }
        }
    });
    std::vector<Measured> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    if (all.empty()) return {};
    std::sort(all.begin(), all.end(), [](const Measured& a, const Measured& b) { return a.jump < b.jump; });
    double total = 0, sum = 0;
    for (const Measured& m : all) total += static_cast<double>(m.length);
    Jumps jumps{static_cast<double>(all.back().jump), static_cast<double>(all.back().jump)};
    for (const Measured& m : all) {
        sum += static_cast<double>(m.length);
        if (sum < 0.99 * total) continue;
        jumps.percentile_99 = static_cast<double>(m.jump);
        break;
    }
    return jumps;
}

}  // namespace surimi
