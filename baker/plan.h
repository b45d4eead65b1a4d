// SPDX-License-Identifier: Apache-2.0
// What a scene calls for, before it is baked: which monitor reaches what, which stages run and why, and what they will
// cost.
#pragma once

#include <string>
#include <vector>

#include "baker/bake.h"
#include "baker/calibration.h"
#include "baker/memory.h"
#include "baker/preparation.h"
#include "baker/reach.h"

namespace surimi {

/// A stage of a bake by the name that it has there, or a part of one.
struct PlannedStage {
    std::string stage;
    bool runs = true;
    std::string why;       ///< it runs, or does not
    double seconds = 0;    ///< of wall time, foretold for this machine as it is now
    double rays = 0;       ///< foretold
    bool is_part = false;  ///< of the stage before; has no seconds of its own
};

struct PlannedMonitor {
    std::vector<Reach> reach;  ///< by surface
    BlockCounts blocks;        ///< of all surfaces
    Calibration calibration;
};

struct Plan {
    int width = 0, height = 0, pages = 1;
    double texels_per_metre = 0;
    size_t texels = 0;                     ///< that triangles touch, of all pages
    std::vector<PlannedMonitor> monitors;  ///< by index in Scene::monitors
    std::vector<PlannedStage> stages;      ///< in the order in which they run
    PlannedMemory memory;
    std::vector<std::string> warnings;  ///< as the bake will give them

    double seconds() const;
    double rays() const;
};

/// The result does not refer to the scene. Deterministic but for seconds and for what memory is measured. Throws what
/// unwrap() throws, Error(interrupted), and Error(usage) where the bake would for want of memory.
Plan plan(const Scene& scene, const BakeSettings& settings, const Progress& progress);

}  // namespace surimi
