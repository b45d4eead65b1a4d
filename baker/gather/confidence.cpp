// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/confidence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr size_t resamples = 2000;  // the percentiles at 2.5 and 97.5 % rest on 50 of them

/// Chance of at most `hits` of `count` when each has chance `share`, in (0, 1).
double chance_of_at_most(size_t hits, size_t count, double share) {
    const double odds = std::log(share) - std::log1p(-share);
    double term =
        static_cast<double>(count) * std::log1p(-share);  // logarithm: it may be far below the smallest double
    double sum = std::exp(term);
    for (size_t i = 0; i < hits; ++i) {
        term += std::log(static_cast<double>(count - i) / static_cast<double>(i + 1)) + odds;
        sum += std::exp(term);
    }
    return sum;
}

}  // namespace

Interval root_mean_interval(std::span<const double> squares, uint64_t key) {
    if (squares.empty()) return {};
    const auto count = static_cast<double>(squares.size());
    std::vector<double> means(resamples);
    parallel_for(resamples, 16, [&](size_t r) {
        const uint64_t own = hash(key, r);
        double sum = 0;
        for (size_t i = 0; i < squares.size(); ++i)
            sum += squares[static_cast<size_t>(unit_double(hash(own + i)) * count)];
        means[r] = sum / count;
    });
    std::sort(means.begin(), means.end());
    const auto root_at = [&](double share) {
        return std::sqrt(std::max(0.0, means[static_cast<size_t>(share * (resamples - 1))]));
    };
    return {root_at(0.025), root_at(0.975)};
}

double largest_share(size_t hits, size_t count) {
    if (hits >= count) return 1;
    // The chance to see so few falls with the share; where it is 5 % the bound lies.
    double low = 0, high = 1;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (chance_of_at_most(hits, count, middle) > 0.05 ? low : high) = middle;
    }
    return high;
}

}  // namespace surimi
