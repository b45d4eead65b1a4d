// SPDX-License-Identifier: Apache-2.0
// The techniques of a study and the settings at which they are measured.
#pragma once

#include <memory>

#include "baker/study/measurement.h"

namespace surimi {

/// A technique at one setting.
struct Trial {
    std::string setting;
    double value = 0;
    std::function<Measurement(const Subject&)> run;
};

struct Technique {
    Series series;  ///< without points
    std::vector<Trial> trials;
};

/// The baker's own methods; `silhouettes` took `seconds` for the whole scene and outlives the techniques.
std::vector<Technique> baker_techniques(const Silhouettes& silhouettes, double seconds);

/// What others do: random, jittered and Sobol-Owen points, probe-and-refine, rays to the closest point, grids of hard
/// shadows, and depth maps, which are rendered when first used.
std::vector<Technique> other_techniques();

}  // namespace surimi
