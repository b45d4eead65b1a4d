// SPDX-License-Identifier: Apache-2.0
#include "baker/preparation.h"

#include "baker/monitor_warnings.h"

namespace surimi {

Preparation prepare(const Scene& scene, const UnwrapSettings& settings, const Progress& progress) {
    Preparation result;
    Stopwatch stopwatch(result.costs);
    result.atlas = unwrap(scene, settings, progress);
    stopwatch.finish("unwrap");
    for (int page = 0; page < result.atlas.pages; ++page)
        result.texels.push_back(find_texels(scene, result.atlas, page));
    stopwatch.finish("texels");
    const size_t before = resident_bytes();
    result.rays = std::make_unique<RayScene>(scene);
    const size_t after = resident_bytes();
    result.rays_bytes = after > before ? after - before : 0;
    result.warnings = monitor_warnings(scene, *result.rays);
    const std::vector<std::string>& of_atlas = result.atlas.warnings;
    result.warnings.insert(result.warnings.end(), of_atlas.begin(), of_atlas.end());
    stopwatch.finish("rays");
    result.silhouettes = find_silhouettes(scene, *result.rays);
    stopwatch.finish("silhouettes");
    return result;
}

}  // namespace surimi
