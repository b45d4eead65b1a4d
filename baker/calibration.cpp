// SPDX-License-Identifier: Apache-2.0
#include "baker/calibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "baker/gather/audit.h"
#include "baker/gather/blocks.h"
#include "baker/post/bilinear_fit.h"
#include "baker/post/fill.h"
#include "baker/post/gutter.h"
#include "baker/post/ratio.h"
#include "baker/post/stitch.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

/// Texels at a tile's rim are lit again where the next tile calls for it, so tiles are drawn two by two.
constexpr uint32_t patch_size = 2 * tile_size;
constexpr size_t patches_per_sample = 40;
constexpr size_t least_patches = 64;
constexpr size_t audited = 4;  // texels; each takes 65,536 rays

class Timer {
  public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// x and y, bit by bit in turn: what is near in this number is near on the map.
uint64_t morton(uint32_t x, uint32_t y) {
    uint64_t code = 0;
    for (uint32_t bit = 0; bit < 16; ++bit)
        code |= uint64_t{(x >> bit) & 1u} << (2 * bit) | uint64_t{(y >> bit) & 1u} << (2 * bit + 1);
    return code;
}

uint64_t patch_of(const Texels& texels, const Texel& texel) {
    const auto width = static_cast<uint32_t>(texels.width);
    return morton(texel.index % width / patch_size, texel.index / width / patch_size);
}

/// Adds what a page's sample says, scaled by how many times the page is larger.
void add(Calibration& result, const Gathered& gathered, double scale, double asked) {
    const GatherStatistics& statistics = gathered.statistics;
    for (size_t i = 0; i < result.methods.size(); ++i) {
        const auto& of = statistics.methods[i];
        result.methods[i].texels += scale * static_cast<double>(of.texels);
        result.methods[i].rays += scale * static_cast<double>(of.rays);
        result.methods[i].seconds += scale * of.seconds;
    }
    result.rays += scale * static_cast<double>(statistics.rays());
    result.failed_checks += scale * static_cast<double>(statistics.failed_checks);
    for (const IrradianceEstimate& estimate : gathered.estimates) {
        if (!(estimate.unshadowed > 0)) continue;
        const auto error = static_cast<double>(estimate.error);
        result.lit += scale;
        result.rms_error += scale * error * error;
        result.share_above += error > asked ? scale : 0;
    }
}

}  // namespace

Texels sample_patches(const Texels& texels, uint64_t seed) {
    std::vector<std::pair<uint64_t, uint32_t>> order;  // patch, number of the texel
    order.reserve(texels.texels.size());
    for (uint32_t i = 0; i < texels.texels.size(); ++i) order.emplace_back(patch_of(texels, texels.texels[i]), i);
    std::ranges::sort(order);
    std::vector<size_t> starts;  // of patches in `order`
    for (size_t i = 0; i < order.size(); ++i)
        if (i == 0 || order[i].first != order[i - 1].first) starts.push_back(i);
    const size_t patches = starts.size();
    starts.push_back(order.size());

    const size_t count = std::min(patches, std::max(least_patches, patches / patches_per_sample));
    std::vector<uint32_t> chosen;
    for (size_t i = 0; i < count; ++i) {
        const size_t begin = i * patches / count, end = (i + 1) * patches / count;
        const double place = unit_double(hash(hash(seed, static_cast<uint64_t>(texels.page)), i));
        const size_t patch = begin + static_cast<size_t>(place * static_cast<double>(end - begin));
        for (size_t k = starts[patch]; k < starts[patch + 1]; ++k) chosen.push_back(order[k].second);
    }
    std::ranges::sort(chosen);
    Texels sample;
    sample.page = texels.page;
    sample.width = texels.width;
    sample.height = texels.height;
    for (const uint32_t i : chosen) {
        Texel texel = texels.texels[i];
        const auto triangles = texels.triangles_of(texel);
        texel.first = static_cast<uint32_t>(sample.triangles.size());
        sample.triangles.insert(sample.triangles.end(), triangles.begin(), triangles.end());
        sample.texels.push_back(texel);
    }
    return sample;
}

Calibration calibrate(const Scene& scene, const Preparation& preparation, size_t monitor,
                      const GatherSettings& settings, const Progress& progress) {
    Calibration result;
    const Timer whole;
    const auto timed_gather = [&](const Texels& texels, double& seconds) {
        const Timer timer;
        Gathered gathered = gather(scene, preparation.atlas, texels, *preparation.rays, preparation.silhouettes,
                                   monitor, settings, progress);
        seconds = timer.seconds();
        return gathered;
    };
    for (const Texels& texels : preparation.texels) {
        const Texels sample = sample_patches(texels, settings.seed);
        result.texels += texels.texels.size();
        result.sampled += sample.texels.size();
        Texels empty;
        empty.page = texels.page;
        empty.width = texels.width;
        empty.height = texels.height;
        double fixed = 0, seconds = 0;
        timed_gather(empty, fixed);
        result.fixed_seconds += fixed;
        result.seconds += fixed;
        if (sample.texels.empty()) continue;
        const Gathered gathered = timed_gather(sample, seconds);
        const double scale = static_cast<double>(texels.texels.size()) / static_cast<double>(sample.texels.size());
        result.seconds += scale * std::max(0.0, seconds - fixed);
        add(result, gathered, scale, settings.error);
    }
    if (result.lit > 0) {
        result.rms_error = std::sqrt(result.rms_error / result.lit);
        result.share_above /= result.lit;
    }
    result.spent = whole.seconds();
    return result;
}

PostSeconds calibrate_post(const Scene& scene, const Preparation& preparation, const PostSettings& settings) {
    PostSeconds seconds;
    const Timer fill_timer;
    std::vector<Channel> channels;
    for (const Texels& texels : preparation.texels) {
        std::vector<IrradianceEstimate> estimates(texels.texels.size());
        for (size_t i = 0; i < estimates.size(); ++i) {  // every other patch is unlit: long borders, as in rooms
            const uint32_t x = texels.texels[i].index % static_cast<uint32_t>(texels.width) / patch_size;
            const uint32_t y = texels.texels[i].index / static_cast<uint32_t>(texels.width) / patch_size;
            if ((x + y) % 2 != 0) continue;
            estimates[i].unshadowed = 1;
            estimates[i].shadowed = static_cast<float>(unit_double(hash(i)));  // no seam agrees
        }
        channels.push_back(visibility_channel(texels, estimates));
    }
    fill(scene, preparation.atlas, preparation.texels, channels, settings);
    for (size_t p = 0; p < channels.size(); ++p) grow_gutters(preparation.texels[p], channels[p], all_rings);
    seconds.fill = fill_timer.seconds();
    const Timer fit_timer;
    const std::vector<Panel> panels =
        scene.monitors.empty() ? std::vector<Panel>() : panels_of(scene.monitors.front(), *preparation.rays);
    for (size_t p = 0; p < channels.size() && settings.fit == Fit::bilinear; ++p)
        fit_bilinear({scene, preparation.atlas, preparation.texels[p], *preparation.rays}, panels, channels[p]);
    seconds.fit = fit_timer.seconds();
    const Timer seams_timer;
    stitch(preparation.atlas, preparation.seams, channels);
    seconds.seams = seams_timer.seconds();
    return seconds;
}

double calibrate_audit(const Scene& scene, const Preparation& preparation, size_t monitor,
                       const GatherSettings& settings) {
    for (const Texels& texels : preparation.texels) {
        const Texels sample = sample_patches(texels, settings.seed);
        const Gathered gathered =
            gather(scene, preparation.atlas, sample, *preparation.rays, preparation.silhouettes, monitor, settings, {});
        if (std::ranges::none_of(gathered.estimates, [](const auto& estimate) { return estimate.unshadowed > 0; }))
            continue;
        const Timer timer;
        audit(scene, preparation.atlas, sample, *preparation.rays, monitor, gathered.estimates, settings, audited, {});
        return timer.seconds() / static_cast<double>(audited);
    }
    return 0;
}

}  // namespace surimi
