// SPDX-License-Identifier: Apache-2.0
// Coefficients of the arctangent near 0 for one edge's angle (M15).
#pragma once

#include <array>

namespace surimi {

/// End of the interval that the polynomials cover: tan(pi / 8), where (r - 1) / (r + 1) is -r.
inline constexpr double arctangent_end = 0.41421356237309504880;

/// atan(r) = r + r^3 (k[0] + k[1] r^2 + k[2] r^4 + ...) for |r| <= arctangent_end. Minimax fits of the relative error
/// by the Remez exchange in 40 digits, our own: 9.8e-16 with nine coefficients for double, 6.7e-10 with five for float.
template <class T>
inline constexpr auto arctangent = std::array<double, 9>{
    -0.333333333332600869, 0.199999999826841074,   -0.142857128729382343, 0.111110544106967968,  -0.0908961508396377115,
    0.0767431892852915376, -0.0651024992501081632, 0.0503742858232076188, -0.0254743905990334913};
template <>
inline constexpr auto arctangent<float> =
    std::array<float, 5>{-0.3333331519f, 0.1999847153f, -0.1424353369f, 0.1059381626f, -0.06078227657f};

/// Squared sine (times the ends' lengths) below which float needs a cosine of at least `least_cosine`.
inline constexpr float least_sine2 = 1e-24f, least_cosine = 1e-6f;

}  // namespace surimi
