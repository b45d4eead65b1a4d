// SPDX-License-Identifier: Apache-2.0
// What stands before light is gathered: atlas, texels, rays, silhouettes, warnings, and what each took.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "baker/gather/silhouettes.h"
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
    Silhouettes silhouettes;
    std::vector<std::string> warnings;  ///< of monitors and atlas

    std::vector<StageCost> costs;  ///< unwrap, texels, rays, silhouettes
    size_t rays_bytes = 0;         ///< by which the process grew with `rays`: about what Embree holds
};

/// The scene must outlive the result. Throws what unwrap() throws, and Error(interrupted).
Preparation prepare(const Scene& scene, const UnwrapSettings& settings, const Progress& progress);

}  // namespace surimi
