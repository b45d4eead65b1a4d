// SPDX-License-Identifier: Apache-2.0
// The whole pipeline: Scene -> Atlas -> texels -> irradiance -> visibility map, or several maps.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "baker/gather/audit.h"
#include "baker/gather/exposure.h"
#include "baker/gather/gather.h"
#include "baker/post/bilinear_fit.h"
#include "baker/post/channel.h"
#include "baker/post/stitch.h"
#include "baker/settings.h"
#include "baker/stage_cost.h"
#include "baker/texel/texels.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/parallel.h"
#include "runtime/map/visibility_map.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// One page of the atlas.
struct BakedPage {
    VisibilityMap map;
    std::array<Image<TexelState>, 3> state;               ///< by channel; empty where there is no monitor
    std::array<Image<IrradianceEstimate>, 3> irradiance;  ///< by channel; the evidence behind the map
};

/// How a monitor's channel came about, and how far it is from the truth.
struct MonitorEvidence {
    GatherStatistics statistics;  ///< of all pages
    BilinearFit fit;              ///< of all pages; zeros where none was asked for
    StitchReport seams;           ///< of all pages; zeros where none were stitched
    std::vector<Audit> audits;    ///< by page; empty when none was asked for
};

struct Bake {
    Atlas atlas;
    std::vector<BakedPage> pages;
    double error = GatherSettings{}.error;  ///< asked for
    ExposureCounts exposure;                ///< what lies inside other geometry, of all pages
    std::vector<MonitorEvidence> evidence;  ///< by index in Scene::monitors
    std::vector<StageCost> costs;
    std::vector<std::string> warnings;
};

/// Bakes scene.monitors into one map for each page of the atlas. The result depends on scene and settings alone, not on
/// the number of threads, nor on how it keeps within settings.memory. Throws what its stages throw, Error(interrupted),
/// and Error(usage) before light is gathered where the memory does not suffice.
Bake bake(const Scene& scene, const BakeSettings& settings, const Progress& progress);

}  // namespace surimi
