// SPDX-License-Identifier: Apache-2.0
#include "runtime/ltc/table.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace surimi {

namespace {

/// Along, lift, skew, depth, albedo, fresnel_root, and two of padding; row by row.
alignas(64) constexpr std::array<std::array<float, ltc_cell_floats>, ltc_size* ltc_size> cells = {{
#include "runtime/ltc/table_data.inc"
}};

struct Place {
    int first;
    double rest;  ///< share of the next one
};

/// Between which two nodes a coordinate in [0, 1] lies.
Place place_of(double coordinate) {
    const double x = coordinate * (ltc_size - 1);
    const int first = std::min(static_cast<int>(x), ltc_size - 2);
    return {first, x - first};
}

std::array<double, 6> numbers(int column, int row) {
    assert(column >= 0 && column < ltc_size && row >= 0 && row < ltc_size);
    std::array<double, 6> result{};
    std::copy_n(cells[static_cast<size_t>(row * ltc_size + column)].begin(), result.size(), result.begin());
    return result;
}

LtcCell cell_of(const std::array<double, 6>& n) {
    return {{n[0], n[1], n[2], n[3]}, n[4], n[5]};
}

}  // namespace

double ltc_column_alpha(int column) {
    const double roughness = static_cast<double>(column) / (ltc_size - 1);
    return std::max(ltc_least_alpha, roughness * roughness);
}

double ltc_row_cosine(int row) {
    const double v = static_cast<double>(row) / (ltc_size - 1);
    return std::max(ltc_least_cosine, (1 - v) * (1 + v));
}

LtcCell ltc_cell(int column, int row) {
    return cell_of(numbers(column, row));
}

const float* ltc_cells() {
    return cells[0].data();
}

LtcLobe ltc_lobe(double roughness, double cosine) {
    const bool is_valid = std::isfinite(roughness) && std::isfinite(cosine);
    const double u = roughness > 0 ? std::min(roughness, 1.0) : 0;  // these comparisons are false for NaN
    const double c = cosine < 1 ? std::max(cosine, ltc_least_cosine) : 1;
    const Place across = place_of(u), down = place_of(std::sqrt(1 - c));
    std::array<double, 6> sum{};
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            const double share = (i ? across.rest : 1 - across.rest) * (j ? down.rest : 1 - down.rest);
            const std::array<double, 6> n = numbers(across.first + i, down.first + j);
            for (size_t k = 0; k < sum.size(); ++k) sum[k] += share * n[k];
        }
    const LtcCell cell = cell_of(sum);
    const Mat3 inverse = inverse_matrix(cell.shape, std::max(ltc_least_alpha, u * u), c);
    const double fresnel = cell.albedo * std::pow(cell.fresnel_root, 5);
    const LtcLobe lobe{inverse, cell.albedo, fresnel, lobe_below_horizon(inverse)};
    return is_valid ? lobe : flagged(lobe);
}

}  // namespace surimi
