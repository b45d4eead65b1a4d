// SPDX-License-Identifier: Apache-2.0
#include "baker/bake.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>

#include "baker/monitor_warnings.h"
#include "baker/post/ratio.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {
namespace {

/// Times the stages of a bake, one after the other. A stage that comes again, for another page, is the same stage.
class Stopwatch {
  public:
    explicit Stopwatch(std::vector<StageCost>& costs) : costs_(costs) {}

    void finish(const std::string& stage, size_t rays = 0) {
        const auto now = std::chrono::steady_clock::now();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        auto cost = std::find_if(costs_.begin(), costs_.end(), [&](const StageCost& c) { return c.stage == stage; });
        if (cost == costs_.end()) cost = costs_.insert(cost, {stage});
        cost->seconds += std::chrono::duration<double>(now - start_).count();
        cost->rays += rays;
        cost->peak_bytes = static_cast<size_t>(usage.ru_maxrss) * 1024;
        start_ = now;
    }

  private:
    std::vector<StageCost>& costs_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Estimates as an image, for the files.
Image<IrradianceEstimate> as_image(const Texels& texels, const std::vector<IrradianceEstimate>& estimates) {
    Image<IrradianceEstimate> image(texels.width, texels.height);
    for (size_t i = 0; i < estimates.size(); ++i) image.pixels[texels.texels[i].index] = estimates[i];
    return image;
}

void store_channel(VisibilityMap& map, const Monitor& monitor, const Image<float>& visibility) {
    for (size_t i = 0; i < visibility.pixels.size(); ++i)
        map.visibility.pixels[i][monitor.channel] = visibility.pixels[i];
    map.monitors[static_cast<size_t>(monitor.channel)] = monitor.name;
}

}  // namespace

Bake bake(const Scene& scene, const BakeSettings& settings, const Progress& progress) {
    Bake result;
    Stopwatch stopwatch(result.costs);

    result.atlas = unwrap(scene, settings.unwrap, progress);
    stopwatch.finish("unwrap");
    std::vector<Texels> texels;
    for (int page = 0; page < result.atlas.pages; ++page) texels.push_back(find_texels(scene, result.atlas, page));
    stopwatch.finish("texels");
    const RayScene rays(scene);
    result.warnings = monitor_warnings(scene, rays);
    result.warnings.insert(result.warnings.end(), result.atlas.warnings.begin(), result.atlas.warnings.end());
    stopwatch.finish("rays");

    const Silhouettes silhouettes;
    result.pages.resize(texels.size());
    for (BakedPage& page : result.pages)  // unused channels stay 1
        page.map.visibility = Image<Vec3f>(result.atlas.width, result.atlas.height, Vec3f(1));
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Monitor& monitor = scene.monitors[m];
        const auto c = static_cast<size_t>(monitor.channel);
        for (size_t p = 0; p < texels.size(); ++p) {
            const Gathered gathered = gather(scene, result.atlas, texels[p], rays, silhouettes, m, settings.gather,
                                             part_of(progress, p, texels.size()));
            stopwatch.finish("light from " + monitor.name, gathered.statistics.rays());

            BakedPage& page = result.pages[p];
            Channel channel = visibility_channel(texels[p], gathered.estimates);
            fill(result.atlas, texels[p], channel.visibility, channel.state);
            store_channel(page.map, monitor, channel.visibility);
            page.state[c] = std::move(channel.state);
            page.irradiance[c] = as_image(texels[p], gathered.estimates);
            stopwatch.finish("fill " + monitor.name);
        }
    }
    return result;
}

}  // namespace surimi
