// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/texel_light.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"

namespace surimi {
namespace {

/// Sobol points of all texels: made once.
const SamplePoints& sample_points() {
    static const SamplePoints points;
    return points;
}

class Average {
  public:
    void add(const PointLight& light) {
        ++result_.points;
        PointLight& sum = result_.light;
        sum.unshadowed += light.unshadowed;
        sum.shadowed += light.shadowed;
        squares_ += light.error * light.unshadowed * light.error * light.unshadowed;
        sum.method = std::max(sum.method, light.method);
        sum.rays += light.rays;
        sum.segments += light.segments;
        sum.has_failed = sum.has_failed || light.has_failed;
        sum.is_dear = sum.is_dear || light.is_dear;
    }
    bool is_usable() const { return !result_.light.has_failed && !result_.light.is_dear; }
    TexelLight value() const {
        TexelLight average = result_;
        const auto count = static_cast<double>(std::max<size_t>(average.points, 1));
        average.light.error = average.light.unshadowed > 0 ? std::sqrt(squares_) / average.light.unshadowed : 0;
        average.light.unshadowed /= count;
        average.light.shadowed /= count;
        return average;
    }

  private:
    TexelLight result_;
    double squares_ = 0;
};

/// Adds what a step of the refinement cost to the next one's account.
TexelLight with_cost_of(TexelLight value, const TexelLight& before) {
    value.points += before.points;
    value.light.rays += before.light.rays;
    value.light.segments += before.light.segments;
    return value;
}

/// The exact way to average where shadows are sharper than a sixteenth of the texel: scrambled points, four times as
/// many at every step, until two steps agree.
TexelLight by_many_points(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface, uint64_t key,
                          PointWorkspace& work) {
    constexpr uint32_t most_points = 1024;
    const Scrambling seeds = scrambling(hash(key, 99));
    const Tolerances limits = tolerances(setup.settings);
    Average average;
    double before = -1;
    for (uint32_t i = 0; i < most_points; ++i) {
        const auto r = scrambled(sobol::point(i), seeds);
        average.add(light_at(setup, sight, surface.sample(r[0], r[1]), hash(key, 100 + i), work));
        if (i + 1 != 64 && i + 1 != 256 && i + 1 != most_points) continue;
        TexelLight value = average.value();
        const double change = before < 0 ? 1 : std::abs(value.light.visibility() - before);
        value.light.error = std::hypot(value.light.error, change / 2);
        if (change / 2 <= limits.footprint || i + 1 == most_points) return value;
        before = value.light.visibility();
    }
    return average.value();
}

}  // namespace

TexelLight average_over_cells(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface, int side,
                              uint64_t key, PointWorkspace& work) {
    Average average;
    for (int y = 0; y < side && average.is_usable(); ++y)
        for (int x = 0; x < side && average.is_usable(); ++x) {
            const SurfacePoint point = surface.sample((x + 0.5) / side, (y + 0.5) / side);
            const auto number = static_cast<uint64_t>(side * side + y * side + x);
            average.add(light_at(setup, sight, point, hash(key, number), work));
        }
    return average.value();
}

TexelLight by_rays(const MonitorSetup& setup, const TexelSurface& surface, double unshadowed, uint64_t key) {
    MonteCarloTask task{setup.rays, setup.sampler, sample_points()};
    task.monitor = setup.monitor;
    task.clearance = setup.largest_clearance();
    task.error = tolerances(setup.settings).monte_carlo;
    task.samples = setup.settings.samples;
    task.key = hash(key, 1);
    const MonteCarloEstimate estimate = monte_carlo(task, surface);
    TexelLight value;
    value.points = 1;
    value.light.method = TexelMethod::monte_carlo;
    value.light.rays = estimate.rays;
    value.light.unshadowed = unshadowed;
    value.light.shadowed = unshadowed * estimate.visibility;
    value.light.error = estimate.error;
    return value;
}

TexelLight refined(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface,
                   const PointLight& center, int first_side, uint64_t key, PointWorkspace& work) {
    const Tolerances limits = tolerances(setup.settings);
    const bool may_trace = !setup.settings.is_exact && setup.settings.method != Method::split;
    const double cost_of_point =
        cost_of_projecting(sight.candidates()) + cost_of_scan(work.segments.count, limits.first_lines);
    TexelLight best{center, 1};
    double change_before = 1;
    for (int side = first_side; side <= 16; side *= 2) {
        TexelLight next = average_over_cells(setup, sight, surface, side, key, work);
        const bool is_usable = !next.light.has_failed && !next.light.is_dear;
        const double change = std::abs(next.light.visibility() - best.light.visibility());
        next = with_cost_of(next, best);
        best = next;
        // Halving the cells leaves a quarter of the error where light is smooth: a third of what the step changed.
        best.light.error = std::hypot(next.light.error, change / 3);
        if (!is_usable) break;
        if (change / 3 <= limits.footprint) return best;
        if (side > 2 && change > 0.6 * change_before) break;  // not smooth at all
        change_before = change;
        double points = side * side, left = change / 3;
        for (; left > limits.footprint; left /= 4) points *= 4;
        if (may_trace && points * cost_of_point > cost_of_average_by_rays(limits.monte_carlo)) break;
    }
    if (may_trace) return with_cost_of(by_rays(setup, surface, best.light.unshadowed, key), best);
    return with_cost_of(by_many_points(setup, sight, surface, key, work), best);
}

}  // namespace surimi
