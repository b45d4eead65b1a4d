// SPDX-License-Identifier: Apache-2.0
// The highest density at which charts fit a map, or the smallest map that holds a density.
#pragma once

#include <vector>

#include "baker/unwrap/footprint.h"
#include "baker/unwrap/pack.h"
#include "runtime/base/parallel.h"

namespace surimi {

struct FitRequest {
    const std::vector<FlatChart>& charts;
    const std::vector<double>& factors;  ///< density of each chart over the atlas' density
    int gutter = 2;
    const Progress& progress;
    int mips = 0;       ///< levels on which at least a texel is left between two charts
    double effort = 1;  ///< factor of the time that better ways to pack are looked for
};

struct Layout {
    MapSize map;
    double texels_per_metre = 0;
    std::vector<TexelChart> shapes;
    std::vector<Placement> placements;
    std::vector<Pose> poses = {};  ///< of each chart; its shape is the number of the axis in pack_axes
};

/// Searches for the density to within about 0.3 % of what the packer can do, in a fixed sequence of tries. Throws
/// Error(usage) when even one texel a chart is too much, or the size is not a multiple of 2^mips.
Layout fit_to_map(const FitRequest& request, const MapSize& map);

/// As above when charts were packed before at `known` and a few of them changed since: goes down from there, never up.
Layout fit_near(const FitRequest& request, const MapSize& map, double known);

/// The smallest square map, a multiple of 4 (and of 2^mips) up to 16384, that holds the charts at this density. Throws
/// Error(usage) when there is none.
Layout fit_to_density(const FitRequest& request, double texels_per_metre);

}  // namespace surimi
