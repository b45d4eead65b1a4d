// SPDX-License-Identifier: Apache-2.0
#include "baker/bake.h"

#include <algorithm>
#include <chrono>

#include "baker/gather/cover.h"
#include "baker/monitor_warnings.h"
#include "baker/post/gutter.h"
#include "baker/post/ratio.h"
#include "baker/preparation.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {
namespace {

/// Times the stages of a bake, one after the other. A stage that comes again, for another page, is the same stage.
class Stopwatch {
  public:
    explicit Stopwatch(std::vector<StageCost>& costs) : costs_(costs) {}

    void finish(const std::string& stage, size_t rays = 0) {
        const auto now = std::chrono::steady_clock::now();
        auto cost = std::find_if(costs_.begin(), costs_.end(), [&](const StageCost& c) { return c.stage == stage; });
        if (cost == costs_.end()) cost = costs_.insert(cost, {stage});
        cost->seconds += std::chrono::duration<double>(now - start_).count();
        cost->rays += rays;
        cost->peak_bytes = peak_resident_bytes();
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

/// The same for the texels again.
std::vector<IrradianceEstimate> of_texels(const Texels& texels, const Image<IrradianceEstimate>& image) {
    std::vector<IrradianceEstimate> estimates;
    estimates.reserve(texels.texels.size());
    for (const Texel& texel : texels.texels) estimates.push_back(image.pixels[texel.index]);
    return estimates;
}

/// Gives texels without a value and gutters theirs, and puts the channels of one monitor into the pages.
void store_channels(Bake& baked, const Scene& scene, const Monitor& monitor, std::span<const Texels> texels,
                    std::vector<Channel>& channels) {
    const auto c = static_cast<size_t>(monitor.channel);
    fill(scene, baked.atlas, texels, channels, {});
    for (size_t p = 0; p < channels.size(); ++p) {
        grow_gutters(texels[p], channels[p], all_rings);
        VisibilityMap& map = baked.pages[p].map;
        for (size_t i = 0; i < map.visibility.pixels.size(); ++i)
            map.visibility.pixels[i][monitor.channel] = channels[p].visibility.pixels[i];
        map.monitors[c] = monitor.name;
        baked.pages[p].state[c] = std::move(channels[p].state);
    }
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
}

/// What light is gathered on, and by which rays.
struct Room {
    const Scene& scene;
    const std::vector<Texels>& texels;  ///< by page
    const RayScene& rays;
};

/// An audit for each page of a monitor that is done. The pages share the texels asked for by how many have light.
std::vector<Audit> audit_pages(const Room& room, const Bake& baked, size_t monitor, const BakeSettings& settings,
                               const Progress& progress) {
    const auto c = static_cast<size_t>(room.scene.monitors[monitor].channel);
    std::vector<size_t> lit{0};  // texels with light on all pages before this one
    for (const BakedPage& page : baked.pages) {
        const auto& pixels = page.irradiance[c].pixels;
        const auto has_light = [](const IrradianceEstimate& estimate) { return estimate.unshadowed > 0; };
        lit.push_back(lit.back() + static_cast<size_t>(std::count_if(pixels.begin(), pixels.end(), has_light)));
    }
    const size_t wanted = std::min(settings.audit, lit.back());
    std::vector<Audit> audits(baked.pages.size());
    for (size_t p = 0; p < audits.size(); ++p) {
        const Texels& texels = room.texels[p];
        const size_t count = lit.back() > 0 ? wanted * lit[p + 1] / lit.back() - wanted * lit[p] / lit.back() : 0;
        if (count > 0)
            audits[p] = audit(room.scene, baked.atlas, texels, room.rays, monitor,
                              of_texels(texels, baked.pages[p].irradiance[c]), settings.gather, count,
                              part_of(progress, p, audits.size()));
    }
    return audits;
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
    append(result.warnings, result.atlas.warnings);
    if (settings.gather.clears_covers) append(result.warnings, describe_covers(scene, rays));
    stopwatch.finish("rays");
    if (settings.finds_inside) result.exposure = find_exposures(scene, result.atlas, rays, texels);
    append(result.warnings, result.exposure.warnings);
    stopwatch.finish("inside");
    const Silhouettes silhouettes = find_silhouettes(scene, rays);
    stopwatch.finish("silhouettes");

    result.error = settings.gather.error;
    result.pages.resize(texels.size());
    for (BakedPage& page : result.pages)  // unused channels stay 1
        page.map.visibility = Image<Vec3f>(result.atlas.width, result.atlas.height, Vec3f(1));
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Monitor& monitor = scene.monitors[m];
        MonitorEvidence& evidence = result.evidence.emplace_back();
        std::vector<Channel> channels;  // by page
        for (size_t p = 0; p < texels.size(); ++p) {
            const Gathered gathered = gather(scene, result.atlas, texels[p], rays, silhouettes, m, settings.gather,
                                             part_of(progress, p, texels.size()));
            evidence.statistics.add(gathered.statistics);
            stopwatch.finish("light from " + monitor.name, gathered.statistics.rays());
            result.pages[p].irradiance[static_cast<size_t>(monitor.channel)] = as_image(texels[p], gathered.estimates);
            channels.push_back(visibility_channel(texels[p], gathered.estimates));
        }
        store_channels(result, scene, monitor, texels, channels);
        stopwatch.finish("fill " + monitor.name);
        if (settings.audit == 0) continue;
        evidence.audits = audit_pages({scene, texels, rays}, result, m, settings, progress);
        stopwatch.finish("audit of " + monitor.name);
    }
    return result;
}

}  // namespace surimi
