// SPDX-License-Identifier: Apache-2.0
// The faces of a surface -> flat charts, as few and as long as a bound on their distortion allows.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/unwrap/distortion.h"
#include "baker/unwrap/flatten.h"
#include "baker/unwrap/half_edge.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/parallel.h"

namespace surimi {

struct CutSettings {
    DistortionBound bound;     ///< of every chart
    DistortionBound comfort;   ///< pieces above it are split further, and joined again only where that pays
    DistortionBound patience;  ///< of a piece that would otherwise fall into crumbs: a little more
    UvQuality quality = UvQuality::medium;
    double texels = 0;  ///< that the surface will have, about: seams finer than the map are not worth the time
};

CutSettings cut_settings(const UnwrapSettings& settings, double texels);

/// Cuts the whole surface at its creases; tries each piece whole, and splits it while it cannot be flattened within the
/// bound without overlap; then joins charts where that saves visible seam. Slivers are charts of their own. Every chart
/// is free of flips and of overlaps deeper than rounding to 22 bits.
/// Throws Error(interrupted) soon after `progress.is_cancelled` answers true.
std::vector<FlatChart> cut_into_charts(const FaceGraph& graph, const CutSettings& settings, const Progress& progress);

}  // namespace surimi
