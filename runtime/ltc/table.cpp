// SPDX-License-Identifier: Apache-2.0
#include "runtime/ltc/table.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace surimi {

namespace {

/// As the file has them: along, lift, skew and depth of both parts, albedo, fresnel_root; row by row.
constexpr std::array<std::array<float, 10>, ltc_size* ltc_size> stored = {{
#include "runtime/ltc/table_data.inc"
}};

using Cells = std::array<std::array<float, ltc_cell_floats>, ltc_size * ltc_size>;

/// The cells of one part, as lookups want them.
constexpr Cells cells_of(LobePart part) {
    Cells cells{};
    for (size_t i = 0; i < cells.size(); ++i) {
        for (size_t k = 0; k < 4; ++k) cells[i][k] = stored[i][k + (part == LobePart::full ? 0 : 4)];
        cells[i][4] = stored[i][8];
        cells[i][5] = stored[i][9];
    }
    return cells;
}

alignas(64) constexpr Cells full_cells = cells_of(LobePart::full);
alignas(64) constexpr Cells schlick_cells = cells_of(LobePart::schlick);

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

std::array<double, 6> numbers(LobePart part, int column, int row) {
    assert(column >= 0 && column < ltc_size && row >= 0 && row < ltc_size);
    const Cells& cells = part == LobePart::full ? full_cells : schlick_cells;
    std::array<double, 6> result{};
    std::copy_n(cells[static_cast<size_t>(row * ltc_size + column)].begin(), result.size(), result.begin());
    return result;
}

LobeShape shape_of(const std::array<double, 6>& n) {
    return {n[0], n[1], n[2], n[3]};
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
    const std::array<double, 6> full = numbers(LobePart::full, column, row);
    return {shape_of(full), shape_of(numbers(LobePart::schlick, column, row)), full[4], full[5]};
}

const float* ltc_cells(LobePart part) {
    return part == LobePart::full ? full_cells[0].data() : schlick_cells[0].data();
}

LtcLobe ltc_lobe(double roughness, double cosine, LobePart part) {
    const bool is_valid = std::isfinite(roughness) && std::isfinite(cosine);
    const double u = roughness > 0 ? std::min(roughness, 1.0) : 0;  // these comparisons are false for NaN
    const double c = cosine < 1 ? std::max(cosine, ltc_least_cosine) : 1;
    const Place across = place_of(u), down = place_of(std::sqrt(1 - c));
    std::array<double, 6> sum{};
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            const double share = (i ? across.rest : 1 - across.rest) * (j ? down.rest : 1 - down.rest);
            const std::array<double, 6> n = numbers(part, across.first + i, down.first + j);
            for (size_t k = 0; k < sum.size(); ++k) sum[k] += share * n[k];
        }
    const Mat3 inverse = inverse_matrix(shape_of(sum), std::max(ltc_least_alpha, u * u), c);
    const double albedo = part == LobePart::full ? sum[4] : sum[4] * std::pow(sum[5], 5);
    const LtcLobe lobe{inverse, albedo, lobe_below_horizon(inverse)};
    return is_valid ? lobe : flagged(lobe);
}

}  // namespace surimi
