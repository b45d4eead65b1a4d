// SPDX-License-Identifier: Apache-2.0
// What one setting of one technique costs, and how far off it is.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "baker/gather/gather.h"
#include "baker/study/reference.h"
#include "baker/study/selection.h"

namespace surimi {

/// All times are CPU seconds of one thread.
struct Measurement {
    std::string setting;  ///< for people: "256 rays", "E = 0.004"
    double value = 0;     ///< the number in it
    double seconds = 0;   ///< for each texel and monitor; what is done once for a map is spread over its lit texels
    double rays = 0;      ///< for each texel and monitor
    double rmse = 0;      ///< of V, the reference's variance taken off; never less than what the sample can tell from 0
    double p999 = 0;      ///< all texels but `allowed_outliers` are within it and three of the reference's errors
    double largest = 0;   ///< error, that of the reference included
};

enum class Family {
    surimi,        ///< what the baker does
    sampling,      ///< pairs of points: converge to V
    approximation  ///< converge to something else
};

/// One technique over its settings, from the cheapest on.
struct Series {
    std::string id;     ///< for tables: "sobol"
    std::string label;  ///< for the plot: "Sobol-Owen"
    std::string notes;  ///< what it is and where it is evaluated
    Family family = Family::sampling;
    std::vector<Measurement> points;
};

/// What is measured, and against what. Everything outlives it.
struct Subject {
    const Scene& scene;
    const Atlas& atlas;
    const Selection& selection;
    const std::vector<StudiedMonitor>& monitors;
    const std::vector<Reference>& references;  ///< one for each of selection.texels
    uint64_t seed = 0;
};

/// The texel as the engine takes it: of a coarse smooth surface, moved off its facets (M63).
TexelSurface surface_of(const Subject& subject, const StudiedTexel& texel);

/// The receiver's estimate by some technique.
using Estimator = std::function<StudyEstimate(const Receiver&)>;

/// Errors of an estimator over the selected texels, and its time: the median of up to five passes as long as they are
/// short. `setup_seconds` is what was done before for the whole map. One thread. The result has no setting's name.
Measurement measure(const Subject& subject, const Estimator& estimator, double setup_seconds);

/// The same of the baker's engine over whole blocks of 8 x 8 texels. What a call costs without texels is its setup.
/// The caller sees to it that gather uses one thread, the calling one.
Measurement measure_engine(const Subject& subject, const Silhouettes& silhouettes, const GatherSettings& settings,
                           double setup_seconds);

/// The errors of values against references, in the Measurement's fields (M58). NaN-free for any finite values.
void set_errors(Measurement& measurement, std::span<const double> values, std::span<const Reference> references);

/// 0.1 % of so many texels, rounded to whole ones: of 500, one is no proof that more than 0.1 % of a map are like it.
size_t allowed_outliers(size_t texels);

/// RMS of the references' standard errors.
double reference_error(std::span<const Reference> references);

/// CPU seconds of the calling thread so far.
double thread_seconds();

}  // namespace surimi
