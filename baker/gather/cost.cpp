// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/cost.h"

#include <algorithm>
#include <cmath>

namespace surimi {

Tolerances tolerances(const GatherSettings& settings) {
    Tolerances result;
    // With exact points only the footprint is estimated, to a quarter.
    const double error = settings.is_exact ? settings.error / 4 : settings.error;
    result.lines = 0.75 * error;
    result.footprint = 0.25 * error;
    // 99.9 % of all texels within the error.
    result.monte_carlo = error / 3;
    result.all_by_rays = error / 3.3;
    // Features between two lines go unseen: (2.8 / lines)^2 / 4 of the panel's square at most.
    result.first_lines = error >= 0.015 ? 16 : error >= 0.003 ? 40 : 64;
    return result;
}

LineLimits lines_for(const Tolerances& limits, double averaged) {
    // Errors of single points fall with their root in the average; and what a point's lines leave out the next one's,
    // which lie elsewhere, may meet. Lines come in fours, of which the estimate is made.
    constexpr int least = 16;
    const double more = std::sqrt(averaged);
    const int first = 4 * static_cast<int>(limits.first_lines / (4 * std::cbrt(averaged)) + 0.5);
    return {limits.lines * more, std::max(first, std::min(least, limits.first_lines))};
}

double cost_of_projecting(size_t candidates) {
    return 200 + 14 * static_cast<double>(candidates);
}

double cost_of_split(size_t segments) {
    const auto k = static_cast<double>(segments);
    return 1000 + 400 * k + 3 * k * k;
}

double cost_of_scan(size_t segments, int lines) {
    return 3000 + 80.0 * lines + (16 + 0.1 * lines) * static_cast<double>(segments);
}

namespace {

constexpr double of_ray = 130;

double cost_of_rays(double rays) {
    return of_ray * std::clamp(rays, 96.0, 65536.0);
}

}  // namespace

// Fits to the rays that Monte Carlo took in rooms (docs/decisions.md).
double cost_of_monte_carlo(double standard_error) {
    return cost_of_rays(5000 * std::pow(1e-3 / standard_error, 1.25));
}

double cost_of_average_by_rays(double standard_error) {
    return cost_of_rays(8000 * std::pow(1e-3 / standard_error, 1.34));
}

bool are_rays_cheaper(size_t candidates, const GatherSettings& settings) {
    if (settings.method != Method::automatic || settings.is_exact) return false;
    const Tolerances limits = tolerances(settings);
    const size_t segments = candidates / 2;
    const double of_point =
        cost_of_projecting(candidates) + std::min(cost_of_split(segments), cost_of_scan(segments, limits.first_lines));
    return of_point > cost_of_average_by_rays(limits.all_by_rays);
}

}  // namespace surimi
