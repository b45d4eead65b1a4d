// SPDX-License-Identifier: Apache-2.0
// The table of fitted lobes: the transformed cosine and the albedo of GGX at a roughness and a view angle.
#pragma once

#include "runtime/base/math.h"
#include "runtime/ltc/lobe.h"

namespace surimi {

/// Cells along each side; columns are even in perceptual roughness, rows in sqrt(1 - N.V) (M27).
inline constexpr int ltc_size = 64;
/// Slope roughness below which lobes stay as wide as here: 2e-5 rad, a hundredth of what a pixel of a 4K screen sees.
inline constexpr double ltc_least_alpha = 1e-5;
/// N.V of the last row; GGX has no limit at 0 for which all roughnesses are at their limit too.
inline constexpr double ltc_least_cosine = 1e-4;

/// What a cell stores, all interpolated linearly (M27).
struct LtcCell {
    LobeShape full, schlick;  ///< of the two parts
    double albedo = 1;        ///< `GgxAlbedo::full`
    double fresnel_root = 0;  ///< fifth root of `GgxAlbedo::fresnel / full`; a mirror has 1 - N.V
};

double ltc_column_alpha(int column);
double ltc_row_cosine(int row);

/// A stored cell; both indices in [0, ltc_size).
LtcCell ltc_cell(int column, int row);

/// Floats from one cell to the next in `ltc_cells`: the four numbers of the part's shape, albedo, fresnel_root, and two
/// of padding.
inline constexpr size_t ltc_cell_floats = 8;
/// All ltc_size x ltc_size stored cells of one part, row by row, on a boundary of 64 bytes, for lookups in SIMD.
const float* ltc_cells(LobePart part);

/// Everything shading needs of one part of the BRDF.
struct LtcLobe {
    Mat3 inverse;   ///< to the cosine's space, from (tangent of the view's plane, bitangent, normal); middle entry 1
    double albedo;  ///< of this part, as in GgxAlbedo; specular albedo = F0 * full + (1 - F0) * schlick (M30)
    double leak;    ///< fraction of the lobe below the true horizon: what is cut there, divide the rest by 1 - leak
};

/// The lobe at a perceptual roughness and N.V, both clamped to [0, 1]. Not a number counts as roughness 0 and N.V 1,
/// the first cell; the result is always finite, and the matrix of the full part regular (where the other's albedo
/// vanishes, its lobe is not determined). Input that is not finite raises FE_INVALID.
LtcLobe ltc_lobe(double roughness, double cosine, LobePart part = LobePart::full);

}  // namespace surimi
