// SPDX-License-Identifier: Apache-2.0
// How close the published table of lobes (Heitz, Dupuy, Hill and Neubelt 2016) comes to GGX, as figures.
#pragma once

#include <array>

namespace surimi::test {

/// Cells of the 64 x 64 table; the published one and ours have the same coordinates (M27).
inline constexpr std::array<int, 8> compared_columns = {4, 8, 16, 24, 32, 40, 48, 63};
inline constexpr std::array<int, 8> compared_rows = {0, 24, 40, 48, 56, 60, 62, 63};

/// Total variation between the published table's lobe and GGX in these cells: half the integral of |difference|,
/// relative to its own albedo. Measured by the project on the table of selfshadow/ltc_code, revision 31e5e96, which it
/// does not contain; rounded. Its last row was fitted at 89.95 degrees, ours at 89.994.
inline constexpr std::array<std::array<double, 8>, 8> published_total_variation = {
    {{.000, .000, .005, .008, .017, .017, .014, .015},
     {.000, .001, .007, .018, .036, .054, .050, .017},
     {.002, .006, .027, .063, .101, .114, .089, .023},
     {.003, .013, .055, .119, .160, .152, .113, .029},
     {.008, .034, .135, .228, .243, .202, .137, .045},
     {.020, .082, .255, .314, .297, .238, .161, .070},
     {.061, .220, .360, .371, .334, .264, .180, .092},
     {.75, .67, .44, .41, .36, .28, .19, .12}}};

}  // namespace surimi::test
