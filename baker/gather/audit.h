// SPDX-License-Identifier: Apache-2.0
// How far a bake is from the truth, on random texels.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/gather/gather.h"

namespace surimi {

struct Audit {
    size_t texels = 0;    ///< measured ones that were drawn
    double rmse = 0;      ///< of V against the truth: the reference's own noise does not count on average
    double rmse_low = 0;  ///< 95 % confidence interval of it, by bootstrap
    double rmse_high = 0;
    double reference_error = 0;  ///< RMS of the references' standard errors
    double largest = 0;          ///< distance from the reference
    size_t beyond = 0;  ///< texels further from the reference than the error asked for and 3 of its standard errors
    double beyond_high = 1;  ///< 95 % upper bound of their share (Clopper and Pearson 1934)
};

/// Compares `count` texels, drawn evenly from those with light, with 65,536 rays of independent random numbers each,
/// spread over texel and monitor: it shares no geometry with splitting and scanlines. Texels that the rays find unlit
/// are not measured. Which texels are drawn depends on page, channel and seed alone.
Audit audit(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays, size_t monitor,
            const std::vector<IrradianceEstimate>& estimates, const GatherSettings& settings, size_t count,
            const Progress& progress);

}  // namespace surimi
