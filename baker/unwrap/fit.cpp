// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "baker/unwrap/climb.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr int largest_map = 16384;
/// Below this share of the highest conceivable density all charts are as small as they get.
constexpr double no_density_share = 1e-7;
const double most_work = 1e6 * (getenv("WORK") ? atoi(getenv("WORK")) : 100);

void tell(const FitRequest& request, double fraction) {
    if (request.progress.is_cancelled && request.progress.is_cancelled())
        throw Error(ErrorKind::interrupted, "interrupted while packing");
    if (request.progress.report) request.progress.report("packing", fraction);
}

/// The orders and rules that win most often.
std::optional<Layout> try_to_pack(const PackTask& task, double density) {
    return try_once(task, density, {{PackOrder::longer_side, PackRule::centre}, {PackOrder::box, PackRule::centre},
                                    {PackOrder::half_perimeter, PackRule::upper_end}});
}

std::optional<Layout> try_both(const PackTask& task, double low, double high) {
    std::optional<Layout> better = try_to_pack(task, high);
    return better ? std::move(better) : try_to_pack(task, low);
}

/// A density that would make the charts as large as the map.
double highest_density(const FitRequest& request, const MapSize& map) {
    double area = 0;
    for (size_t i = 0; i < request.charts.size(); ++i)
        area += request.charts[i].area * request.factors[i] * request.factors[i];
    const double texels = static_cast<double>(map.width) * map.height;
    return area > 0 ? std::sqrt(texels / area) : 1.0;  // nothing but slivers: any density will do
}

/// Smallest multiple of 4 for which `fits` is true, between sizes known to fail and to fit. The caller has
/// seen that it fits at `high`.
template <class Fits>
int smallest_size(int low, int high, const Fits& fits) {
    while (high - low > 4) {
        const int middle = (low + high) / 8 * 4;
        (fits(middle) ? high : low) = middle;
    }
    return high;
}

[[noreturn]] void refuse(const FitRequest& request, const MapSize& map) {
    const std::string charts = std::to_string(request.charts.size()) + " charts";
    const std::string asked = std::to_string(map.width) + " x " + std::to_string(map.height);
    const auto fits = [&](int size) {
        const MapSize square{size, size};
        return try_to_pack(make_task(request, square), highest_density(request, square) * no_density_share).has_value();
    };
    int high = 4;
    while (high < largest_map && !fits(high)) high *= 2;
    if (high == largest_map && !fits(high))
        throw Error(ErrorKind::usage, charts + " do not fit any map up to 16384 x 16384; split the scene");
    const std::string size = std::to_string(smallest_size(high / 2, high, fits));
    throw Error(ErrorKind::usage, "a map of " + asked + " texels is too small for " + charts +
                                      ", even at one texel each; " + "the smallest that can hold them is --size " +
                                      size + "x" + size);
}

/// Largest density, to about 2 %, that a count of texels does not rule out.
double promising_density(const PackTask& task) {
    double high = highest_density(task.request, task.map);
    const double lowest = high * no_density_share;
    double low = high / 2;
    while (low > lowest && !could_fit(task, low)) {
        high = low;
        low /= 2;
    }
    for (int i = 0; i < 5; ++i) {  // 2^(1/32)
        const double middle = std::sqrt(low * high);
        (could_fit(task, middle) ? low : high) = middle;
    }
    return high;
}

}  // namespace

Layout fit_to_map(const FitRequest& request, const MapSize& map) {
    tell(request, 0);
    const PackTask task = make_task(request, map);
    ClimbLimits limits;
    limits.start = promising_density(task);
    limits.lowest = highest_density(request, map) * no_density_share;
    limits.most_work = static_cast<uint64_t>(most_work * request.effort);
    Climb result = climb_coarse_to_fine(task, limits);
    if (!result.best) refuse(request, map);
    tell(request, 1);
    return std::move(*result.best);
}

Layout fit_near(const FitRequest& request, const MapSize& map, double known) {
    const PackTask task = make_task(request, map);
    double density = known;
    for (double step = 0.998; density > 0.8 * known; step *= step * step) {
        tell(request, 1);
        std::optional<Layout> layout = try_both(task, density * step, density);
        if (layout) return std::move(*layout);
        density *= step * step;
    }
    return fit_to_map(request, map);
}

Layout fit_to_density(const FitRequest& request, double texels_per_metre) {
    tell(request, 0);
    const auto layout_of = [&](int size) {
        tell(request, 0.5);
        return try_to_pack(make_task(request, {size, size}), texels_per_metre);
    };
    int high = 4;
    while (high < largest_map && !could_fit(make_task(request, {high, high}), texels_per_metre)) high *= 2;
    std::optional<Layout> best = layout_of(high);
    while (!best && high < largest_map) {
        high *= 2;
        best = layout_of(high);
    }
    if (!best) {
        const double most = 0.9 * highest_density(request, {largest_map, largest_map});
        throw Error(ErrorKind::usage, std::to_string(texels_per_metre) +
                                          " texels per metre do not fit a map of 16384 x 16384 texels; about " +
                                          std::to_string(most) + " may");
    }
    smallest_size(high / 2, high, [&](int size) {
        std::optional<Layout> smaller = layout_of(size);
        if (!smaller) return false;
        best = std::move(smaller);
        return true;
    });
    tell(request, 1);
    return std::move(*best);
}

}  // namespace surimi
