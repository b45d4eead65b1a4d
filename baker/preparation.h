// SPDX-License-Identifier: Apache-2.0
// What stands before light is gathered: atlas, texels, rays, silhouettes, seams, warnings, and what each took.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "baker/gather/exposure.h"
#include "baker/gather/silhouettes.h"
#include "baker/post/seams.h"
#include "baker/settings.h"
#include "baker/stage_cost.h"
#include "baker/texel/texels.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/scene.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

struct Preparation {
    Atlas atlas;
    std::vector<Texels> texels;      ///< by page
    std::unique_ptr<RayScene> rays;  ///< never empty
    ExposureCounts exposure;         ///< of all pages
    Silhouettes silhouettes;
    Seams seams;                        ///< empty where none are stitched
    std::vector<std::string> warnings;  ///< of monitors, atlas and exposure

    std::vector<StageCost> costs;  ///< unwrap, texels, rays, inside, silhouettes, seams
    size_t rays_bytes = 0;         ///< by which the process grew with `rays`: about what Embree holds
};

/// The scene must outlive the result. Throws what unwrap() throws, and Error(interrupted).
Preparation prepare(const Scene& scene, const BakeSettings& settings, const Progress& progress);

}  // namespace surimi
