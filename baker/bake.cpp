// SPDX-License-Identifier: Apache-2.0
#include "baker/bake.h"

#include <algorithm>
#include <utility>

#include "baker/memory.h"
#include "baker/post/bilinear_fit.h"
#include "baker/post/fill.h"
#include "baker/post/gutter.h"
#include "baker/post/ratio.h"
#include "baker/preparation.h"

namespace surimi {
namespace {

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

void store(BakedPage& page, const Monitor& monitor, Channel channel) {
    const auto c = static_cast<size_t>(monitor.channel);
    for (size_t i = 0; i < channel.visibility.pixels.size(); ++i)
        page.map.visibility.pixels[i][monitor.channel] = channel.visibility.pixels[i];
    page.map.monitors[c] = monitor.name;
    page.state[c] = std::move(channel.state);
}

struct AuditTask {
    const Scene& scene;
    const Preparation& preparation;
    const std::vector<BakedPage>& pages;
};

/// An audit for each page of a monitor that is done. The pages share the texels asked for by how many have light.
std::vector<Audit> audit_pages(const AuditTask& task, size_t monitor, const BakeSettings& settings,
                               const Progress& progress) {
    const auto& [scene, preparation, pages] = task;
    const auto c = static_cast<size_t>(scene.monitors[monitor].channel);
    std::vector<size_t> lit{0};  // texels with light on all pages before this one
    for (const BakedPage& page : pages) {
        const auto& pixels = page.irradiance[c].pixels;
        const auto has_light = [](const IrradianceEstimate& estimate) { return estimate.unshadowed > 0; };
        lit.push_back(lit.back() + static_cast<size_t>(std::count_if(pixels.begin(), pixels.end(), has_light)));
    }
    const size_t wanted = std::min(settings.audit, lit.back());
    std::vector<Audit> audits(pages.size());
    for (size_t p = 0; p < audits.size(); ++p) {
        const Texels& texels = preparation.texels[p];
        const size_t count = lit.back() > 0 ? wanted * lit[p + 1] / lit.back() - wanted * lit[p] / lit.back() : 0;
        if (count > 0)
            audits[p] = audit(scene, preparation.atlas, texels, *preparation.rays, monitor,
                              of_texels(texels, pages[p].irradiance[c]), settings.gather, count,
                              part_of(progress, p, audits.size()));
    }
    return audits;
}

}  // namespace

Bake bake(const Scene& scene, const BakeSettings& settings, const Progress& progress) {
    check_memory_of_maps(scene, settings);
    Preparation preparation = prepare(scene, settings, progress);
    GatherSettings gather_settings = settings.gather;
    gather_settings.band_rows = rows_within_memory(scene, preparation, settings);
    PostSettings post_settings = settings.post;
    post_settings.inside_rings = 1 << settings.unwrap.mips;  // texels that the coarsest level's reads meet

    Bake result;
    result.costs = preparation.costs;
    result.warnings = preparation.warnings;
    result.exposure = preparation.exposure;
    result.error = settings.gather.error;
    Stopwatch stopwatch(result.costs);
    result.pages.resize(preparation.texels.size());
    for (BakedPage& page : result.pages)  // unused channels stay 1
        page.map.visibility = Image<Vec3f>(preparation.atlas.width, preparation.atlas.height, Vec3f(1));
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Monitor& monitor = scene.monitors[m];
        MonitorEvidence& evidence = result.evidence.emplace_back();
        std::vector<Channel> channels;  // by page
        for (size_t p = 0; p < result.pages.size(); ++p) {
            const Texels& texels = preparation.texels[p];
            Gathered gathered = gather(scene, preparation.atlas, texels, *preparation.rays, preparation.silhouettes, m,
                                       gather_settings, part_of(progress, p, result.pages.size()));
            evidence.statistics.add(gathered.statistics);
            channels.push_back(visibility_channel(texels, gathered.estimates));
            result.pages[p].irradiance[static_cast<size_t>(monitor.channel)] = as_image(texels, gathered.estimates);
        }
        stopwatch.finish("light from " + monitor.name, evidence.statistics.rays());
        fill(scene, preparation.atlas, preparation.texels, channels, post_settings);
        // Bilinear reads at a border meet the first ring of the gutter, so that it is fitted and stitched as well.
        for (size_t p = 0; p < channels.size(); ++p) grow_gutters(preparation.texels[p], channels[p], 1);
        stopwatch.finish("fill " + monitor.name);
        if (post_settings.fit == Fit::bilinear) {
            const std::vector<Panel> panels = panels_of(monitor, *preparation.rays);
            for (size_t p = 0; p < channels.size(); ++p)
                evidence.fit.add(fit_bilinear(
                    {scene, preparation.atlas, preparation.texels[p], *preparation.rays, settings.gather.lifts_smooth},
                    panels, channels[p]));
            stopwatch.finish("fit " + monitor.name);
        }
        evidence.seams = stitch(preparation.atlas, preparation.seams, channels);
        stopwatch.finish("seams " + monitor.name);
        for (size_t p = 0; p < channels.size(); ++p) {
            grow_gutters(preparation.texels[p], channels[p], all_rings);
            store(result.pages[p], monitor, std::move(channels[p]));
        }
        stopwatch.finish("fill " + monitor.name);
        if (settings.audit == 0) continue;
        evidence.audits = audit_pages({scene, preparation, result.pages}, m, settings, progress);
        stopwatch.finish("audit of " + monitor.name);
    }
    result.atlas = std::move(preparation.atlas);
    return result;
}

}  // namespace surimi
