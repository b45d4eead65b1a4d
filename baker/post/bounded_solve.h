// SPDX-License-Identifier: Apache-2.0
// Sparse linear least squares between bounds.
#pragma once

#include <cstdint>
#include <vector>

namespace surimi {

/// |R x - r|^2 + sum of weights_i x_i^2 is to be least with low <= x <= high.
struct BoundedLeastSquares {
    struct Entry {
        uint32_t equation = 0;
        uint32_t unknown = 0;
        double value = 0;
    };
    std::vector<Entry> entries;   ///< of R; those of one place add up
    std::vector<double> right;    ///< r: one for each equation
    std::vector<double> weights;  ///< above 0; one for each unknown
    std::vector<double> low;      ///< at most 0
    std::vector<double> high;     ///< at least 0
};

/// The x for which it is least, always within the bounds (M61). Near linear where the unknowns form chains.
std::vector<double> solve(const BoundedLeastSquares& problem);

}  // namespace surimi
