// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/attempt.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "baker/unwrap/axes.h"
#include "runtime/base/error.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

/// A chart that found no place moves forward as if it were so much larger, ...
constexpr double boost = 1.2;
/// ... and slowly back: what is left of that after every try.
constexpr double memory = 0.95;
/// Charts shorter than this share of the map's side, were the map full, are tried in their tightest box alone: there
/// are many of them, and little is lost around them.
constexpr double least_turned = 0.04;

constexpr int any_turns = -1;

/// Charts at one density, in every pose that is tried.
struct Shaped {
    std::vector<uint64_t> work;                   ///< of each chart, as Occupancy::work counts
    std::vector<std::vector<TexelChart>> shapes;  ///< of each chart and axis
    std::vector<std::vector<Mask>> masks;
};

/// Nanoseconds, about: rows of edges and of masks.
uint64_t shaping_work(const Outline& outline, const TexelChart& shape) {
    return 30 * outline.size() + 600 * static_cast<uint64_t>(std::max(shape.width, shape.height));
}

/// Whether a plan may want the chart in this pose.
bool is_wanted(const std::vector<PackPlan>& plans, size_t chart, int shape, int turns) {
    return std::any_of(plans.begin(), plans.end(), [&](const PackPlan& plan) {
        if (plan.poses.empty()) return true;
        const Pose& pose = plan.poses[chart];
        return pose.shape == shape && (turns == any_turns || pose.turns == turns);
    });
}

/// Adds the wanted masks of one shape; those of all turns when none of the wanted is there, because a symmetrical
/// chart's mask comes under one of its names only.
void add_masks(std::vector<Mask> masks, const std::vector<PackPlan>& plans, size_t chart, std::vector<Mask>& result) {
    const auto is_good = [&](const Mask& m) { return is_wanted(plans, chart, m.shape, m.turns); };
    const bool has_good = std::any_of(masks.begin(), masks.end(), is_good);
    for (Mask& mask : masks)
        if (!has_good || is_good(mask)) result.push_back(std::move(mask));
}

void shape_chart(const PackTask& task, size_t i, double density, const std::vector<PackPlan>& plans, Shaped& result) {
    const FlatChart& chart = task.request.charts[i];
    const MapSize& map = task.map;
    for (int a = 0; a < static_cast<int>(task.axes[i].size()); ++a) {
        result.shapes[i].emplace_back();
        if (!is_wanted(plans, i, a, any_turns)) continue;
        const Vec2& axis = task.axes[i][static_cast<size_t>(a)];
        TexelChart shape = to_texels(chart, density * task.request.factors[i], map, axis, task.cell);
        // A chart wider than the map needs no mask to be refused, and could be too large for memory.
        const auto fits = [&](int width, int height) { return width <= map.width && height <= map.height; };
        if (!fits(shape.width, shape.height) && !fits(shape.height, shape.width)) continue;
        std::vector<Mask> masks = make_masks(task.outlines[i], shape, map, task.cell);
        std::erase_if(masks, [&](const Mask& m) { return !fits(m.width * task.cell, m.height * task.cell); });
        for (Mask& mask : masks) mask.shape = a;
        add_masks(std::move(masks), plans, i, result.masks[i]);
        result.work[i] += shaping_work(task.outlines[i], shape);
        result.shapes[i].back() = std::move(shape);
    }
}

Shaped shape_charts(const PackTask& task, double density, const std::vector<PackPlan>& plans) {
    const size_t count = task.request.charts.size();
    Shaped result;
    result.work.resize(count);
    result.shapes.resize(count);
    result.masks.resize(count);
    constexpr size_t grain = 64;  // charts: some are one texel, some half the map
    parallel_for(count, count < grain ? 1 : grain, [&](size_t i) { shape_chart(task, i, density, plans, result); });
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
    for (double& b : plan.boosts) b = 1 + memory * (b - 1);
    for (const uint32_t c : failed) plan.boosts[c] *= boost;
}

}  // namespace

PackTask make_task(const FitRequest& request, const MapSize& map) {
    const int cell = 1 << request.mips;
    if (map.width % cell != 0 || map.height % cell != 0)
        throw Error(ErrorKind::usage, "gutters that survive " + std::to_string(request.mips) +
                                          " mip levels need a map whose sides are multiples of " +
                                          std::to_string(cell) + " texels, not " + std::to_string(map.width) + " x " +
                                          std::to_string(map.height));
    const size_t count = request.charts.size();
    PackTask task{request,
                  std::vector<Outline>(count),
                  std::vector<std::vector<Vec2>>(count),
                  map,
                  cell,
                  std::max(1, (request.gutter + cell - 1) / cell)};
    double area = 0;
    for (size_t i = 0; i < count; ++i) area += request.charts[i].area * request.factors[i] * request.factors[i];
    constexpr size_t grain = 64;
    parallel_for(count, grain, [&](size_t i) {
        const FlatChart& chart = request.charts[i];
        task.outlines[i] = chart_outline(chart);
        const double longer = request.factors[i] * std::max(chart.extent.x, chart.extent.y);
        if (!chart.is_sliver && longer > least_turned * std::sqrt(area))
            task.axes[i] = pack_axes(chart, task.outlines[i], map);
        else
            task.axes[i] = {Vec2(1, 0)};
    });
    return task;
}

std::vector<PackPlan> first_plans() {
    return {{PackOrder::longer_side, PackRule::centre}, {PackOrder::box, PackRule::centre}};
}

bool could_fit(const PackTask& task, double density) {
    return could_fit(task, shape_charts(task, density, {PackPlan{}}).masks);
}

Attempt attempt(const PackTask& task, double density, std::vector<PackPlan>& plans, bool is_learning) {
    Attempt result;
    Shaped shaped = shape_charts(task, density, plans);
    result.work = std::accumulate(shaped.work.begin(), shaped.work.end(), uint64_t{0});
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

std::optional<Layout> try_once(const PackTask& task, double density) {
    std::vector<PackPlan> plans = first_plans();
    return attempt(task, density, plans, false).layout;
}

}  // namespace surimi
