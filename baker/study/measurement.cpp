// SPDX-License-Identifier: Apache-2.0
#include "baker/study/measurement.h"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "baker/gather/lift_pieces.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr int most_passes = 5;
constexpr double long_enough = 0.25;  // seconds; a pass of that length is not repeated

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Median CPU seconds of `pass`.
template <class Pass>
double timed(const Pass& pass) {
    std::vector<double> seconds;
    double sum = 0;
    while (seconds.size() < most_passes && sum < long_enough) {
        const double start = thread_seconds();
        pass();
        seconds.push_back(thread_seconds() - start);
        sum += seconds.back();
    }
    return median(seconds);
}

}  // namespace

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double reference_error(std::span<const Reference> references) {
    double sum = 0;
    for (const Reference& reference : references) sum += reference.error * reference.error;
    return std::sqrt(sum / static_cast<double>(std::max<size_t>(1, references.size())));
}

size_t allowed_outliers(size_t texels) {
    return (texels + 500) / 1000;
}

void set_errors(Measurement& measurement, std::span<const double> values, std::span<const Reference> references) {
    if (values.empty()) return;
    const double noise = reference_error(references);
    std::vector<double> errors;
    double sum = 0, sum_of_squares = 0;  // of squared errors without the reference's share
    for (size_t i = 0; i < values.size(); ++i) {
        const double error = std::abs(values[i] - references[i].visibility), own = references[i].error;
        errors.push_back(std::max(0.0, error - 3 * std::max(own, noise)));
        measurement.largest = std::max(measurement.largest, error);
        sum += error * error - own * own;
        sum_of_squares += std::pow(error * error - own * own, 2);
    }
    std::ranges::sort(errors);
    const auto count = static_cast<double>(errors.size());
    const double mean = sum / count;
    const double uncertainty = std::sqrt(std::max(0.0, sum_of_squares / count - mean * mean) / count);
    measurement.rmse = std::sqrt(std::max(mean, uncertainty));
    measurement.p999 = errors[errors.size() - 1 - allowed_outliers(errors.size())];
}

TexelSurface surface_of(const Subject& subject, const StudiedTexel& texel) {
    const Texels& texels = subject.selection.blocks[texel.monitor][texel.page];
    TexelSurface surface(subject.scene, subject.atlas, texels, texels.texels[texel.texel]);
    const StudiedMonitor& light = subject.monitors[texel.monitor];
    lift_pieces(light.rays, panels_of(light.monitor(), light.rays), surface);
    return surface;
}

Measurement measure(const Subject& subject, const Estimator& estimator, double setup_seconds) {
    const std::vector<StudiedTexel>& chosen = subject.selection.texels;
    std::vector<double> values(chosen.size());
    size_t rays = 0;
    const double seconds = timed([&] {
        rays = 0;
        for (size_t i = 0; i < chosen.size(); ++i) {
            const TexelSurface surface = surface_of(subject, chosen[i]);
            const StudyEstimate estimate =
                estimator({subject.monitors[chosen[i].monitor], surface, hash(subject.seed, i)});
            values[i] = estimate.visibility;
            rays += estimate.rays;
        }
    });
    const auto count = static_cast<double>(std::max<size_t>(1, chosen.size()));
    Measurement result;
    result.seconds = seconds / count + setup_seconds / static_cast<double>(std::max<size_t>(1, subject.selection.lit));
    result.rays = static_cast<double>(rays) / count;
    set_errors(result, values, subject.references);
    return result;
}

Measurement measure_engine(const Subject& subject, const Silhouettes& silhouettes, const GatherSettings& settings,
                           double setup_seconds) {
    const auto& blocks = subject.selection.blocks;
    std::vector<std::vector<Gathered>> gathered(blocks.size());
    const auto gather_page = [&](const Texels& texels, size_t monitor) {
        return gather(subject.scene, subject.atlas, texels, subject.monitors[monitor].rays, silhouettes, monitor,
                      settings, {});
    };
    const double setup = timed([&] {
        for (size_t m = 0; m < blocks.size(); ++m) {
            Texels none;
            none.width = blocks[m][0].width;
            none.height = blocks[m][0].height;
            gather_page(none, m);
        }
    });
    const double seconds = timed([&] {
        for (size_t m = 0; m < blocks.size(); ++m) {
            gathered[m].clear();
            for (const Texels& texels : blocks[m]) gathered[m].push_back(gather_page(texels, m));
        }
    });

    std::vector<double> values;
    for (const StudiedTexel& texel : subject.selection.texels) {
        const IrradianceEstimate& e = gathered[texel.monitor][texel.page].estimates[texel.texel];
        values.push_back(e.unshadowed > 0 ? static_cast<double>(e.shadowed) / static_cast<double>(e.unshadowed) : 0);
    }
    size_t rays = 0;
    for (const auto& pages : gathered)
        for (const Gathered& page : pages) rays += page.statistics.rays();
    const auto measured = static_cast<double>(std::max<size_t>(1, subject.selection.lit_in_blocks));
    const auto lit = static_cast<double>(std::max<size_t>(1, subject.selection.lit));
    const auto pages = static_cast<double>(blocks.empty() ? 1 : blocks[0].size());
    Measurement result;
    result.seconds = std::max(0.0, seconds - pages * setup) / measured + (pages * setup + setup_seconds) / lit;
    result.rays = static_cast<double>(rays) / measured;
    set_errors(result, values, subject.references);
    return result;
}

}  // namespace surimi
