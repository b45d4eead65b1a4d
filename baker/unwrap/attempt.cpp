// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/attempt.h"

#include <algorithm>
#include <cmath>

#include "baker/unwrap/axes.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

/// A chart that found no place moves forward as if it were so much larger, ...
constexpr double boost = 1.2;
/// ... and slowly back: exponent of its boost with every try.
constexpr double memory = 0.95;

/// Charts at one density, in every pose that is tried.
struct Shaped {
    std::vector<std::vector<TexelChart>> shapes;  ///< of each chart and axis
    std::vector<std::vector<Mask>> masks;
};

void shape_chart(const PackTask& task, size_t i, double density, Shaped& result) {
    const FlatChart& chart = task.request.charts[i];
    const MapSize& map = task.map;
    for (const Vec2& axis : task.axes[i]) {
        TexelChart shape = to_texels(chart, density * task.request.factors[i], map, axis, task.cell);
        // A chart wider than the map needs no mask to be refused, and could be too large for memory.
        const bool fits_in_some_turn = std::max(shape.width, shape.height) <= std::max(map.width, map.height) &&
                                       std::min(shape.width, shape.height) <= std::min(map.width, map.height);
        std::vector<Mask> masks;
        if (fits_in_some_turn) masks = make_masks(chart, shape, map, task.cell);
        for (Mask& mask : masks) {
            if (mask.width * task.cell > map.width || mask.height * task.cell > map.height) continue;
            mask.shape = static_cast<int>(result.shapes[i].size());
            result.masks[i].push_back(std::move(mask));
        }
        result.shapes[i].push_back(std::move(shape));
    }
}

Shaped shape_charts(const PackTask& task, double density) {
    const size_t count = task.request.charts.size();
    Shaped result{std::vector<std::vector<TexelChart>>(count), std::vector<std::vector<Mask>>(count)};
    constexpr size_t grain = 64;  // charts: some are one texel, some half the map
    parallel_for(count, count < grain ? 1 : grain, [&](size_t i) { shape_chart(task, i, density, result); });
    return result;
}

MapSize cells_of(const PackTask& task) {
    return {task.map.width / task.cell, task.map.height / task.cell};
}

bool could_fit(const PackTask& task, const std::vector<std::vector<Mask>>& masks) {
    for (const auto& m : masks)
        if (m.empty()) return false;
    const MapSize cells = cells_of(task);
    const double room = static_cast<double>(cells.width + task.gutter) * (cells.height + task.gutter);
    return least_texels(masks, task.gutter) <= room;
}

void learn(const std::vector<uint32_t>& failed, size_t count, PackPlan& plan) {
    plan.boosts.resize(count, 1);
    for (double& b : plan.boosts) b = std::pow(b, memory);
    for (const uint32_t c : failed) plan.boosts[c] *= boost;
}

}  // namespace

PackTask make_task(const FitRequest& request, const MapSize& map) {
    const int cell = 1 << request.mips;
    PackTask task{request, {}, map, cell, std::max(1, (request.gutter + cell - 1) / cell)};
    task.axes.resize(request.charts.size());
    parallel_for(request.charts.size(), 64, [&](size_t i) { task.axes[i] = pack_axes(request.charts[i], map); });
    return task;
}

bool could_fit(const PackTask& task, double density) {
    return could_fit(task, shape_charts(task, density).masks);
}

Attempt attempt(const PackTask& task, double density, std::vector<PackPlan>& plans, bool is_learning) {
    Attempt result;
    Shaped shaped = shape_charts(task, density);
    if (!could_fit(task, shaped.masks)) return result;
    const PackCharts charts = prepare_charts(std::move(shaped.masks));
    const size_t count = charts.masks.size();
    std::vector<Packing> packings(plans.size());
    parallel_for(plans.size(), 1, [&](size_t i) {
        packings[i] = pack(charts, cells_of(task), task.gutter, plans[i], is_learning ? 1 + count / 20 : 1);
    });
    for (const Packing& packing : packings) result.work += packing.work;
    const auto is_good = [](const Packing& packing) { return packing.failed.empty(); };
    const auto good = std::find_if(packings.begin(), packings.end(), is_good);
    if (good == packings.end()) {
        for (size_t i = 0; is_learning && i < plans.size(); ++i) learn(packings[i].failed, count, plans[i]);
        return result;
    }
    result.winner = static_cast<size_t>(good - packings.begin());
    result.layout = Layout{task.map, density, {}, std::move(good->placements), {}};
    for (size_t i = 0; i < count; ++i) {
        const auto mask = static_cast<size_t>(result.layout->placements[i].mask);
        const Mask& m = charts.masks[i][mask];
        result.layout->placements[i].x *= task.cell;
        result.layout->placements[i].y *= task.cell;
        result.layout->poses.push_back({m.shape, m.turns});
        result.layout->shapes.push_back(std::move(shaped.shapes[i][static_cast<size_t>(m.shape)]));
    }
    return result;
}

std::optional<Layout> try_once(const PackTask& task, double density, std::vector<PackPlan> plans) {
    return attempt(task, density, plans, false).layout;
}

}  // namespace surimi
