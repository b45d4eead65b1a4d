// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/audit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "baker/gather/confidence.h"
#include "baker/gather/cover.h"
#include "baker/gather/exposure.h"
#include "baker/gather/monte_carlo.h"
#include "baker/gather/panel.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr int rays_of_half = 1 << 15;
constexpr uint64_t audit_key = 0x61756469740a;  // what sets these random numbers apart from those of the bake

/// A texel's distance from two references that know nothing of each other.
struct Measured {
    bool is_lit = false;
    double first = 0, second = 0;  // V of the bake less that of the reference
    double noise = 0;              // estimated standard error of the references' mean
    double mean() const { return 0.5 * (first + second); }
};

/// Indices of `count` of those texels that have light, or of all if there are fewer; ascending.
std::vector<size_t> draw(const std::vector<IrradianceEstimate>& estimates, size_t count, uint64_t key) {
    std::vector<std::pair<uint64_t, size_t>> tickets;
    for (size_t i = 0; i < estimates.size(); ++i)
        if (estimates[i].unshadowed > 0) tickets.emplace_back(hash(key, i), i);
    count = std::min(count, tickets.size());
    const auto end = tickets.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(tickets.begin(), end, tickets.end());
    std::vector<size_t> drawn;
    for (auto ticket = tickets.begin(); ticket != end; ++ticket) drawn.push_back(ticket->second);
    std::sort(drawn.begin(), drawn.end());
    return drawn;
}

Measured measure(MonteCarloTask task, const TexelSurface& surface, const IrradianceEstimate& estimate) {
    const uint64_t key = task.key;
    task.samples = rays_of_half;
    task.key = hash(key, 1);
    const MonteCarloEstimate first = monte_carlo(task, surface);
    task.key = hash(key, 2);
    const MonteCarloEstimate second = monte_carlo(task, surface);
    const double visibility = static_cast<double>(estimate.shadowed) / static_cast<double>(estimate.unshadowed);
    return {first.is_lit && second.is_lit, visibility - first.visibility, visibility - second.visibility,
            0.5 * std::hypot(first.error, second.error)};
}

Audit summarise(const std::vector<Measured>& measured, double error, uint64_t key) {
    Audit result;
    std::vector<double> squares;
    double references = 0;
    for (const Measured& one : measured) {
        if (!one.is_lit) continue;
        // Noise of the two halves is independent, so that it cancels from the product on average, without being known.
        squares.push_back(one.first * one.second);
        const double half_difference = 0.5 * (one.first - one.second);
        references += half_difference * half_difference;
        result.largest = std::max(result.largest, std::abs(one.mean()));
        if (std::abs(one.mean()) > error + 3 * one.noise) ++result.beyond;
    }
    result.texels = squares.size();
    result.beyond_high = largest_share(result.beyond, result.texels);
    if (squares.empty()) return result;
    const auto count = static_cast<double>(squares.size());
    double sum = 0;
    for (const double square : squares) sum += square;
    result.rmse = std::sqrt(std::max(0.0, sum / count));
    result.reference_error = std::sqrt(references / count);
    const Interval interval = root_mean_interval(squares, key);
    result.rmse_low = interval.low;
    result.rmse_high = interval.high;
    return result;
}

}  // namespace

Audit audit(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays, size_t monitor,
            const std::vector<IrradianceEstimate>& estimates, const GatherSettings& settings, size_t count,
            const Progress& progress) {
    const Monitor& light = scene.monitors[monitor];
    const MonitorSampler sampler(light);
    const SamplePoints points;
    double clearance = 0;
    std::vector<Panel> panels = panels_of(light, rays);
    if (settings.clears_covers) clear_covers(rays, monitor, panels);
    for (const Panel& panel : panels) clearance = std::max(clearance, panel.clearance);
    const uint64_t key = hash(hash(hash(audit_key, settings.seed), static_cast<uint64_t>(light.channel)),
                              static_cast<uint64_t>(texels.page));
    const std::vector<size_t> drawn = draw(estimates, count, key);
    std::vector<Measured> measured(drawn.size());
    parallel_stage("audit of " + light.name, drawn.size(), 1, progress, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Texel& texel = texels.texels[drawn[i]];
            const MonteCarloTask task{.rays = rays,
                                      .sampler = sampler,
                                      .points = points,
                                      .monitor = monitor,
                                      .clearance = clearance,
                                      .key = hash(key, texel.index)};
            measured[i] =
                measure(task, exposed_surface({scene, atlas, texels, rays, settings.lifts_smooth}, texel, panels),
                        estimates[drawn[i]]);
        }
    });
    return summarise(measured, settings.error, hash(key, 0));
}

}  // namespace surimi
