// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr int largest_map = 16384;
/// Below this share of the highest conceivable density all charts are as small as they get.
constexpr double no_density_share = 1e-7;

using MaskSets = std::vector<std::vector<Mask>>;

void tell(const FitRequest& request, double fraction) {
    if (request.progress.is_cancelled && request.progress.is_cancelled())
        throw Error(ErrorKind::interrupted, "interrupted while packing");
    if (request.progress.report) request.progress.report("packing", fraction);
}

MaskSets shape_charts(const FitRequest& request, Layout& layout) {
    MaskSets masks(request.charts.size());
    layout.shapes.resize(request.charts.size());
    constexpr size_t grain = 64;  // charts: some are one texel, some half the map
    parallel_for(request.charts.size(), grain, [&](size_t i) {
        layout.shapes[i] = to_texels(request.charts[i], layout.texels_per_metre * request.factors[i], layout.map);
        // A chart wider than the map needs no mask to be refused, and could be too large for memory.
        const bool is_too_large =
            std::max(layout.shapes[i].width, layout.shapes[i].height) > std::max(layout.map.width, layout.map.height);
        if (!is_too_large) masks[i] = make_masks(request.charts[i], layout.shapes[i], layout.map);
    });
    return masks;
}

bool could_fit(const FitRequest& request, const MaskSets& masks, const MapSize& map) {
    for (const auto& m : masks)
        if (m.empty()) return false;
    const double room = static_cast<double>(map.width + request.gutter) * (map.height + request.gutter);
    return least_texels(masks, request.gutter) <= room;
}

bool could_fit(const FitRequest& request, const MapSize& map, double density) {
    Layout layout{map, density, {}, {}};
    const MaskSets masks = shape_charts(request, layout);
    return could_fit(request, masks, map);
}

std::optional<Layout> try_to_pack(const FitRequest& request, const MapSize& map, double density) {
    Layout layout{map, density, {}, {}};
    const MaskSets masks = shape_charts(request, layout);
    if (!could_fit(request, masks, map)) return std::nullopt;
    auto placements = pack(masks, map, request.gutter);
    if (!placements) return std::nullopt;
    layout.placements = std::move(*placements);
    return layout;
}

/// Two tries side by side: the better one that fits. Always both, so that the result does not depend on the
/// threads.
std::optional<Layout> try_both(const FitRequest& request, const MapSize& map, double low, double high) {
    std::array<std::optional<Layout>, 2> tries;
    parallel_for(2, 1, [&](size_t i) { tries[i] = try_to_pack(request, map, i == 0 ? low : high); });
    return tries[1] ? std::move(tries[1]) : std::move(tries[0]);
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
        return try_to_pack(request, square, highest_density(request, square) * no_density_share).has_value();
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
double promising_density(const FitRequest& request, const MapSize& map) {
    double high = highest_density(request, map);
    const double lowest = high * no_density_share;
    double low = high / 2;
    while (low > lowest && !could_fit(request, map, low)) {
        high = low;
        low /= 2;
    }
    for (int i = 0; i < 5; ++i) {  // 2^(1/32)
        const double middle = std::sqrt(low * high);
        (could_fit(request, map, middle) ? low : high) = middle;
    }
    return high;
}

}  // namespace

Layout fit_to_map(const FitRequest& request, const MapSize& map) {
    tell(request, 0);
    double high = promising_density(request, map);
    const double lowest = highest_density(request, map) * no_density_share;
    tell(request, 0.2);
    std::optional<Layout> best;
    double low = high;
    for (double step = 0.94; !best; step *= step) {  // charts usually fill more than 85 % of what a count promises
        if (low <= lowest) refuse(request, map);
        high = low;
        low = std::max(lowest, high * step * step);
        best = try_both(request, map, low, std::max(lowest, high * step));
    }
    if (best->texels_per_metre > low)
        low = best->texels_per_metre;
    else
        high = std::sqrt(low * high);  // the upper of the two tries failed
    for (int i = 0; i < 3; ++i) {      // thirds: 6 % -> 0.25 %
        tell(request, 0.4 + 0.15 * i);
        const double third = std::cbrt(high / low);
        std::optional<Layout> better = try_both(request, map, low * third, low * third * third);
        if (!better)
            high = low * third;
        else if (better->texels_per_metre > low * third * 1.0000001)
            low = better->texels_per_metre;
        else {
            high = low * third * third;
            low = better->texels_per_metre;
        }
        if (better) best = std::move(better);
    }
    // A packing may fail at one density and succeed a little above: one more look.
    std::optional<Layout> luckier =
        try_both(request, map, best->texels_per_metre * 1.005, best->texels_per_metre * 1.01);
    if (luckier) best = std::move(luckier);
    tell(request, 1);
    return std::move(*best);
}

Layout fit_near(const FitRequest& request, const MapSize& map, double known) {
    double density = known;
    for (double step = 0.998; density > 0.8 * known; step *= step * step) {
        tell(request, 1);
        std::optional<Layout> layout = try_both(request, map, density * step, density);
        if (layout) return std::move(*layout);
        density *= step * step;
    }
    return fit_to_map(request, map);
}

Layout fit_to_density(const FitRequest& request, double texels_per_metre) {
    tell(request, 0);
    const auto layout_of = [&](int size) {
        tell(request, 0.5);
        return try_to_pack(request, {size, size}, texels_per_metre);
    };
    int high = 4;
    while (high < largest_map && !could_fit(request, {high, high}, texels_per_metre)) high *= 2;
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
