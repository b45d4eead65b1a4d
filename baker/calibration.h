// SPDX-License-Identifier: Apache-2.0
// A small part of the work, done and timed, so that the whole can be foretold.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/gather/gather.h"
#include "baker/preparation.h"

namespace surimi {

/// Some patches of two by two tiles of a page, all their texels: about one of every 40, at least 64, spread over the
/// map in Morton order with a random one in every stretch. Depends on texels and seed alone.
Texels sample_patches(const Texels& texels, uint64_t seed);

/// What gather() will do for one monitor on all pages, from sampled patches. All but the seconds is the same in every
/// run.
struct Calibration {
    struct OfMethod {
        double texels = 0;   ///< of the whole map
        double rays = 0;     ///< of the whole map
        double seconds = 0;  ///< of CPU, of the whole map
    };
    std::array<OfMethod, texel_method_count> methods;  ///< by TexelMethod
    size_t texels = 0;                                 ///< of all pages
    size_t sampled = 0;                                ///< of them
    double lit = 0;                                    ///< texels with light, of all pages
    double rays = 0;
    double failed_checks = 0;
    double rms_error = 0;      ///< of the estimated errors of lit texels
    double share_above = 0;    ///< of lit texels, whose estimated error is above the one asked for
    double fixed_seconds = 0;  ///< of wall time that the calls cost whatever the texels
    double seconds = 0;        ///< of wall time, the fixed ones included
    double spent = 0;          ///< seconds of wall time that finding out took
};

Calibration calibrate(const Scene& scene, const Preparation& preparation, size_t monitor,
                      const GatherSettings& settings, const Progress& progress);

/// Seconds of wall time of what comes after light, all pages, one monitor.
struct PostSeconds {
    double fill = 0;   ///< visibility of estimates, values for what has none, gutters
    double fit = 0;    ///< fitting values to bilinear reads, where it is asked for
    double seams = 0;  ///< stitching them
    double sum() const { return fill + fit + seams; }
};
PostSeconds calibrate_post(const Scene& scene, const Preparation& preparation, const PostSettings& settings);

/// Seconds for one audited texel of the first page that has light in its sample; 0 where none has.
double calibrate_audit(const Scene& scene, const Preparation& preparation, size_t monitor,
                       const GatherSettings& settings);

}  // namespace surimi
