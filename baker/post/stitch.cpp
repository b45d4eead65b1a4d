// SPDX-License-Identifier: Apache-2.0
#include "baker/post/stitch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "baker/post/bounded_solve.h"
#include "baker/post/stitch_parts.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

// Against the wish of a measured texel to stay, for half a texel of seam (M60).
constexpr double seam_weight = 100;
// Of a texel whose value is its neighbours'.
constexpr double guess_weight = 0.1;

double weight_of(std::span<const Channel> pages, uint64_t texel) {
    return state_of(pages, texel) == TexelState::covered ? 1 : guess_weight;
}

/// weight * (jump + its change) is to be 0, in those texels of the sample that belong to the part.
void add_equation(BoundedLeastSquares& problem, const StitchPart& part, const SeamSample& sample, double jump,
                  double weight) {
    bool is_here = false;
    for (size_t k = 0; k < sample.count; ++k) {
        const auto at = std::lower_bound(part.texels.begin(), part.texels.end(), sample.texels[k]);
        if (at == part.texels.end() || *at != sample.texels[k]) continue;
        is_here = true;
        problem.entries.push_back({static_cast<uint32_t>(problem.right.size()),
                                   static_cast<uint32_t>(at - part.texels.begin()), weight * sample.weights[k]});
    }
    if (is_here) problem.right.push_back(-weight * jump);
}

/// In the changes of the part's texels (M60).
BoundedLeastSquares problem_of(const Atlas& atlas, const Seams& seams, std::span<const Channel> pages,
                               const StitchPart& part) {
    BoundedLeastSquares problem;
    for (const uint32_t p : part.pieces) {
        const SeamPiece& piece = seams.pieces[p];
        const size_t steps = steps_of(piece);
        const double step = 2 * texels_along(piece) / static_cast<double>(steps);  // in half texels
        for_each_place(atlas, piece, [&](const SeamSample& sample, size_t i) {
            if (!is_seen(pages, sample)) return;
            const double share = i == 0 || i == steps ? 0.5 : 1;
            add_equation(problem, part, sample, jump(pages, sample), std::sqrt(seam_weight * step * share));
        });
    }
    for (const uint64_t texel : part.texels) {
        const double value = visibility_of(pages, texel);
        problem.low.push_back(-value);
        problem.high.push_back(1 - value);
        problem.weights.push_back(weight_of(pages, texel));
    }
    return problem;
}

/// A fifth of an 8-bit step at its finest, in the dark: what is less fades out along seams and would only take from
/// texels that they are exactly 0 or 1.
constexpr double least_change = 0x1p-14;

}  // namespace

StitchReport stitch(const Atlas& atlas, const Seams& seams, std::span<Channel> pages) {
    StitchReport report;
    report.pieces = seams.pieces.size();
    for (const SeamPiece& piece : seams.pieces) report.metres += piece.length;
    report.before = measure_jumps(atlas, seams, pages);
    const std::vector<StitchPart> parts = find_stitch_parts(atlas, seams, pages);
    std::vector<std::vector<float>> values(parts.size());
    parallel_for(parts.size(), 1, [&](size_t p) {
        const std::vector<double> change = solve(problem_of(atlas, seams, pages, parts[p]));
        for (size_t i = 0; i < parts[p].texels.size(); ++i) {
            const double value = visibility_of(pages, parts[p].texels[i]);
            const double moved = std::abs(change[i]) < least_change ? value : std::clamp(value + change[i], 0.0, 1.0);
            values[p].push_back(static_cast<float>(moved));
        }
    });
    const size_t size = pages.empty() ? 1 : pages[0].visibility.pixels.size();
    for (size_t p = 0; p < parts.size(); ++p) {
        for (size_t i = 0; i < parts[p].texels.size(); ++i) {
            const uint64_t texel = parts[p].texels[i];
            float& pixel = pages[texel / size].visibility.pixels[texel % size];
            const double move = std::abs(static_cast<double>(values[p][i]) - static_cast<double>(pixel));
            if (move > 0) ++report.texels;
            report.largest_move = std::max(report.largest_move, move);
            pixel = values[p][i];
        }
    }
    report.after = measure_jumps(atlas, seams, pages);
    return report;
}

}  // namespace surimi
