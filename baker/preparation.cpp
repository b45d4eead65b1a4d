// SPDX-License-Identifier: Apache-2.0
#include "baker/preparation.h"

#include "baker/gather/cover.h"
#include "baker/monitor_warnings.h"

namespace surimi {
namespace {

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

Preparation prepare(const Scene& scene, const BakeSettings& settings, const Progress& progress) {
    Preparation result;
    Stopwatch stopwatch(result.costs);
    result.atlas = unwrap(scene, settings.unwrap, progress);
    stopwatch.finish("unwrap");
    for (int page = 0; page < result.atlas.pages; ++page)
        result.texels.push_back(find_texels(scene, result.atlas, page));
    stopwatch.finish("texels");
    const size_t before = resident_bytes();
    result.rays = std::make_unique<RayScene>(scene);
    const size_t after = resident_bytes();
    result.rays_bytes = after > before ? after - before : 0;
    result.warnings = monitor_warnings(scene, *result.rays);
    append(result.warnings, result.atlas.warnings);
    if (settings.gather.clears_covers) append(result.warnings, describe_covers(scene, *result.rays));
    stopwatch.finish("rays");
    if (settings.finds_inside) result.exposure = find_exposures(scene, result.atlas, *result.rays, result.texels);
    append(result.warnings, result.exposure.warnings);
    stopwatch.finish("inside");
    result.silhouettes = find_silhouettes(scene, *result.rays);
    stopwatch.finish("silhouettes");
    if (settings.post.stitches_seams) result.seams = find_seams(scene, result.atlas);
    stopwatch.finish("seams");
    return result;
}

}  // namespace surimi
