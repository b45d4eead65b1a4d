// SPDX-License-Identifier: Apache-2.0
// What a sample says about the whole, with its uncertainty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace surimi {

struct Interval {
    double low = 0;
    double high = 0;
};

/// 95 % confidence interval of the root of the mean of a population from which `squares` were drawn, by 2000 bootstrap
/// resamples (percentiles; Efron 1979). Squares may be negative where a variance was taken off; a negative mean counts
/// as 0. {0, 0} for none. Parallel; the result depends on squares and key alone.
Interval root_mean_interval(std::span<const double> squares, uint64_t key);

/// The largest share of a population that 95 % confidence leaves when `hits` of `count` drawn ones have a property
/// (upper bound of Clopper and Pearson 1934, one-sided): with none of n it is about 3 / n. 1 for count 0.
double largest_share(size_t hits, size_t count);

}  // namespace surimi
