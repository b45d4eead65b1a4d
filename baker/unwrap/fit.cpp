// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/fit.h"

#include <algorithm>
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
/// Spent on looking for better ways to pack, for each of at most two sizes of the map: 0.3 s of one core, about. Twice
/// of it gains 0.5 %, more nothing.
constexpr double most_work = 4e8;

void tell(const FitRequest& request, double fraction) {
    if (request.progress.is_cancelled && request.progress.is_cancelled())
        throw Error(ErrorKind::interrupted, "interrupted while packing");
    if (request.progress.report) request.progress.report("packing", fraction);
}

/// A density that would make the charts as large as the map.
double highest_density(const FitRequest& request, const MapSize& map) {
    double area = 0;
    for (size_t i = 0; i < request.charts.size(); ++i)
        area += request.charts[i].area * request.factors[i] * request.factors[i];
    const double texels = static_cast<double>(map.width) * map.height;
    return area > 0 ? std::sqrt(texels / area) : 1.0;  // nothing but slivers: any density will do
}

/// Sizes that are proposed are multiples of this.
int size_unit(const FitRequest& request) {
    return std::max(4, 1 << request.mips);
}

/// Smallest multiple of `unit` for which `fits` is true, between sizes known to fail and to fit. The caller has
/// seen that it fits at `high`.
template <class Fits>
int smallest_size(int low, int high, int unit, const Fits& fits) {
    while (high - low > unit) {
        const int middle = (low + high) / (2 * unit) * unit;
        (fits(middle) ? high : low) = middle;
    }
    return high;
}

[[noreturn]] void refuse(const PackTask& refused) {
    const FitRequest& request = refused.request;
    std::string charts = std::to_string(request.charts.size()) + " charts";
    if (request.mips > 0) charts += " with gutters on " + std::to_string(request.mips) + " mip levels";
    const std::string asked = std::to_string(refused.map.width) + " x " + std::to_string(refused.map.height);
    PackTask task = refused;
    const auto fits = [&](int size) {
        task.map = {size, size};
        return try_once(task, highest_density(request, task.map) * no_density_share).has_value();
    };
    const int unit = size_unit(request);
    int high = unit;
    while (high < largest_map && !fits(high)) high *= 2;
    if (high == largest_map && !fits(high))
        throw Error(ErrorKind::usage, charts + " do not fit any map up to 16384 x 16384; split the scene" +
                                          (request.mips > 0 ? ", or ask for fewer mip levels" : ""));
    const std::string size = std::to_string(high == unit ? unit : smallest_size(high / 2, high, unit, fits));
    throw Error(ErrorKind::usage, "a map of " + asked + " texels is too small for " + charts +
                                      ", even at one texel each; the smallest that can hold them is --size " + size +
                                      "x" + size);
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
    std::optional<Layout> best = climb(task, limits);
    if (!best) refuse(task);
    tell(request, 1);
    return std::move(*best);
}

Layout fit_near(const FitRequest& request, const MapSize& map, double known) {
    tell(request, 0);
    const PackTask task = make_task(request, map);
    ClimbLimits limits;
    limits.start = limits.highest = known;
    limits.lowest = std::min(known, highest_density(request, map) * no_density_share);
    limits.most_work = static_cast<uint64_t>(most_work * request.effort);
    std::optional<Layout> best = climb(task, limits);
    if (!best) refuse(task);
    tell(request, 1);
    return std::move(*best);
}

Layout fit_to_density(const FitRequest& request, double texels_per_metre) {
    tell(request, 0);
    const int unit = size_unit(request);
    PackTask task = make_task(request, {largest_map, largest_map});
    const auto could_fit_at = [&](int size) {
        task.map = {size, size};
        return could_fit(task, texels_per_metre);
    };
    const auto layout_of = [&](int size) {
        tell(request, 0.5);
        task.map = {size, size};
        return try_once(task, texels_per_metre);
    };
    int high = unit;
    while (high < largest_map && !could_fit_at(high)) high *= 2;
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
    const auto fits = [&](int size) {
        std::optional<Layout> smaller = layout_of(size);
        if (!smaller) return false;
        best = std::move(smaller);
        return true;
    };
    if (high > unit) smallest_size(high / 2, high, unit, fits);
    tell(request, 1);
    return std::move(*best);
}

}  // namespace surimi
