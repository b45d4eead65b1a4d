// SPDX-License-Identifier: Apache-2.0
#include "baker/bake.h"

#include <sys/resource.h>

#include <chrono>

#include "baker/monitor_warnings.h"
#include "baker/post/ratio.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {
namespace {

/// Times the stages of a bake, one after the other.
class Stopwatch {
  public:
    explicit Stopwatch(std::vector<StageCost>& costs) : costs_(costs) {}

    void finish(const std::string& stage, size_t rays = 0) {
        const auto now = std::chrono::steady_clock::now();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        costs_.push_back({stage, std::chrono::duration<double>(now - start_).count(), rays,
                          static_cast<size_t>(usage.ru_maxrss) * 1024});
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

void store_channel(VisibilityMap& map, int channel, const Image<float>& visibility) {
    for (size_t i = 0; i < visibility.pixels.size(); ++i) map.visibility.pixels[i][channel] = visibility.pixels[i];
}

}  // namespace

Bake bake(const Scene& scene, const BakeSettings& settings, const Progress& progress) {
    Bake result;
    Stopwatch stopwatch(result.costs);

    result.atlas = unwrap(scene, settings.unwrap, progress);
    stopwatch.finish("unwrap");
    const Texels texels = find_texels(scene, result.atlas);
    stopwatch.finish("texels");
    const RayScene rays(scene);
    result.warnings = monitor_warnings(scene, rays);
    result.warnings.insert(result.warnings.end(), result.atlas.warnings.begin(), result.atlas.warnings.end());
    stopwatch.finish("rays");

    result.map.visibility = Image<Vec3f>(result.atlas.width, result.atlas.height, Vec3f(1));  // unused channels stay 1
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Monitor& monitor = scene.monitors[m];
        const auto c = static_cast<size_t>(monitor.channel);
        const Gathered gathered = gather(scene, result.atlas, texels, rays, m, settings.gather, progress);
        stopwatch.finish("light from " + monitor.name, gathered.rays);

        Channel channel = visibility_channel(texels, gathered.estimates);
        fill(result.atlas, texels, channel.visibility, channel.state);
        store_channel(result.map, monitor.channel, channel.visibility);
        result.map.monitors[c] = monitor.name;
        result.state[c] = std::move(channel.state);
        result.irradiance[c] = as_image(texels, gathered.estimates);
        stopwatch.finish("fill " + monitor.name);
    }
    return result;
}

}  // namespace surimi
