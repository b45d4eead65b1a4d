// SPDX-License-Identifier: Apache-2.0
// What stands before light is gathered: atlas, texels, rays, silhouettes, and the time that each took.
#pragma once

#include <memory>
#include <vector>

#include "baker/gather/silhouettes.h"
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

    double unwrap_seconds = 0, texels_seconds = 0, rays_seconds = 0, silhouettes_seconds = 0;
    size_t rays_bytes = 0;  ///< by which the process grew with `rays`: about what Embree holds
};

/// The scene must outlive the result. Throws what unwrap() throws, and Error(interrupted).
Preparation prepare(const Scene& scene, const UnwrapSettings& settings, const Progress& progress);

/// Bytes that the process holds in memory now, from the kernel; 0 where it does not tell.
size_t resident_bytes();

/// The same at its highest so far.
size_t peak_resident_bytes();

}  // namespace surimi
