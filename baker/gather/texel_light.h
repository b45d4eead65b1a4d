// SPDX-License-Identifier: Apache-2.0
// The light that a texel gets, as an average over its surface.
#pragma once

#include "baker/gather/gather.h"
#include "baker/gather/monte_carlo.h"
#include "baker/gather/point_light.h"
#include "baker/texel/texel_surface.h"

namespace surimi {

/// A texel average and what it took.
struct TexelLight {
    PointLight light;
    size_t points = 0;
    bool is_by_center = false;  ///< see LitTexel
    double spread = 0;          ///< by how much points of one piece differ in visibility, on average over the pieces
};

/// Middles of side x side cells of a texel; of one of several pieces each piece has cells of about that size, and at
/// least one. Errors of the points are added as independent ones. Stops at the first point that failed or is too dear.
TexelLight average_over_cells(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface, int side,
                              uint64_t key, PointWorkspace& work);

/// What is known of a texel before it is refined.
struct Beginning {
    PointLight center;
    double footprint = 0;  ///< what the average may differ from it (footprint.h); infinite where nothing is known
    bool has_rim = false;  ///< shadows may lie along its sides, or across a corner: they have to be looked at
    bool is_unlike_center = false;  ///< four points have to be compared with sixteen, not with it
    bool is_cut = false;            ///< along contacts: neighbours do not tell what its parts are like
};

/// Refines from the value at the centre: four points, sixteen and so on, until two steps agree or rays would be
/// cheaper, because shadows are sharper than that or silhouettes too many. With a method that settings force by more
/// and more points in place of rays.
TexelLight refined(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface,
                   const Beginning& from, uint64_t key, PointWorkspace& work);

/// By rays, until the standard error of V is `error`; `unshadowed` > 0.
TexelLight by_rays(const MonitorSetup& setup, const TexelSurface& surface, double unshadowed, double error,
                   uint64_t key);

}  // namespace surimi
