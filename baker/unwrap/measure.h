// SPDX-License-Identifier: Apache-2.0
// How good an atlas is for a lightmap, in numbers that do not know how it was made.
#pragma once

#include <cstddef>
#include <cstdint>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

/// How a flat triangle lies in space: the singular values of the map from texels to metres, largest first. Both are 0
/// for a triangle without area in space or on the map (needles of 1e-12 of their longest edge squared count as such).
/// (Sander, Snyder, Gortler and Hoppe 2001, "Texture mapping progressive meshes")
struct Stretch {
    double largest = 0;   ///< metres a texel: 1 / largest is the density in the worst direction
    double smallest = 0;  ///< metres a texel in the direction across
};
Stretch stretch_of(const Scene& scene, const Atlas& atlas, uint32_t surface, uint32_t triangle);

struct UnwrapNumbers {
    size_t triangles = 0;               ///< of surfaces that are on the map; all that follows is about those alone
    size_t degenerate_triangles = 0;    ///< no area in space to speak of; left out of all that follows
    size_t collapsed_triangles = 0;     ///< area in space and none on the map; left out of stretch and density
    size_t charts = 0;                  ///< with at least one triangle that is not degenerate
    size_t single_triangle_charts = 0;  ///< with exactly one
    size_t mirrored_charts = 0;         ///< clockwise in (u, v), by most of their area
    double area = 0;                    ///< in space, square metres

    double density_p1 = 0;  ///< texels a metre in the worst direction: this or less on 1 % of the area
    double density_p50 = 0;
    double density_p99 = 0;

    // Means are weighted with the area in space; s1 >= s2 are the singular values from texels to metres, scaled so that
    // an atlas of one density without distortion has s1 = s2 = 1.
    double l2_stretch = 0;           ///< root of the mean of (s1^2 + s2^2) / 2; 1 at best (Sander et al. 2001)
    double linf_stretch = 0;         ///< largest s1
    double symmetric_dirichlet = 0;  ///< mean of s1^2 + s2^2 + 1 / s1^2 + 1 / s2^2; 4 at best
    double angle_mean = 0;           ///< of s1 / s2
    double angle_p99 = 0;
    double area_mean = 0;  ///< of the larger of s1 s2 and its inverse
    double area_p99 = 0;

    double seam_length = 0;  ///< metres of edges whose sides lie apart on the map, each once
    double smooth_seam_length =
        0;  ///< of those between two triangles that bend by less than 40 degrees: seams that show
    double seam_over_root_area = 0;
    double smooth_seam_over_root_area = 0;

    double area_share = 0;     ///< area of the flat triangles over that of all pages
    double touched_share = 0;  ///< texels that charts touch over all
    /// area * q^2 / texels of all pages, q being density_p1: the share of the map that would do if every place had the
    /// resolution of the worst. Stretch and packing in one number; 1 at best.
    double density_efficiency = 0;
};

/// Measures an atlas without overlaps. n log n in triangles, linear in texels. Nothing is NaN, whatever the scene.
UnwrapNumbers measure(const Scene& scene, const Atlas& atlas);

/// Bends below this angle are seams that show in a lightmap; radians.
inline constexpr double smooth_bend = 40 * pi / 180;

/// A side of a triangle where its chart ends.
struct ChartSide {
    TriangleRef triangle;
    uint32_t corner = 0;     ///< from this one to the next
    bool is_smooth = false;  ///< a seam between two triangles that bend by less than smooth_bend
};

/// Where charts end: at seams and at the rim of the mesh. Degenerate triangles have none.
std::vector<ChartSide> chart_sides(const Scene& scene, const Atlas& atlas);

}  // namespace surimi
