// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/climb.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr double fall = 0.97;  ///< factor of the density until charts fit; the gap that it leaves is then halved
constexpr double close = 1.002;
constexpr double least_step = 1.002;
constexpr double most_step = 1.02;
constexpr size_t kept_successes = 3;

/// A climb that goes on.
struct Climber {
    const PackTask& task;
    std::vector<PackPlan> plans;
    uint64_t most_work = 0;
    uint64_t work = 0;
    std::optional<Layout> best = {};
    std::vector<PackPlan> successes = {};  ///< plans of the best few layouts, the best first, with their poses
};

bool try_density(Climber& climber, double density) {
    const Progress& progress = climber.task.request.progress;
    if (progress.is_cancelled && progress.is_cancelled())
        throw Error(ErrorKind::interrupted, "interrupted while packing");
    const double done = static_cast<double>(climber.work) / static_cast<double>(climber.most_work + 1);
    if (progress.report) progress.report("packing", std::min(1.0, done));

    // Learning takes longer, since a failed attempt then goes on to its end.
    Attempt next = attempt(climber.task, density, climber.plans, climber.work < climber.most_work);
    // At least a little, so that small work comes to an end.
    climber.work += std::max<uint64_t>(next.work, climber.most_work / 500);
    if (!next.layout) return false;
    PackPlan plan = climber.plans[next.winner];
    plan.poses = next.layout->poses;
    climber.successes.insert(climber.successes.begin(), std::move(plan));
    climber.successes.resize(std::min(climber.successes.size(), kept_successes));
    climber.best = std::move(next.layout);
    return true;
}

void run(Climber& climber, const ClimbLimits& limits) {
    double high = std::min(limits.start / fall, limits.highest);
    double density = limits.start;
    while (!try_density(climber, density)) {
        if (density <= limits.lowest) return;
        high = density;
        density = std::max(limits.lowest, density * fall);
    }
    while (high > density * close) {
        const double middle = std::sqrt(density * high);
        (try_density(climber, middle) ? density : high) = middle;
    }
    double step = least_step;
    while (climber.work < climber.most_work && climber.best->texels_per_metre * step <= limits.highest) {
        const bool has_risen = try_density(climber, climber.best->texels_per_metre * step);
        step = has_risen ? std::min(most_step, 1 + 2 * (step - 1)) : std::max(least_step, 1 + 0.5 * (step - 1));
    }
}

/// How many times smaller the copy of a large map is: charts keep a few dozen texels across on average.
int coarseness(const PackTask& task) {
    constexpr int least_side = 768;
    constexpr double least_across = 20;
    const double texels = static_cast<double>(task.map.width) * task.map.height;
    const double across = std::sqrt(texels / static_cast<double>(task.request.charts.size()));
    const int side = std::min(task.map.width, task.map.height);
    int factor = 1;
    while (across / (2 * factor) >= least_across && side / (2 * factor) >= least_side) factor *= 2;
    return factor;
}

PackTask coarse_copy(const PackTask& task, int factor) {
    PackTask copy = task;
    copy.map = {task.map.width / factor, task.map.height / factor};
    copy.cell = std::max(1, task.cell / factor);
    copy.gutter = std::max(1, (task.gutter * task.cell + factor / 2) / (factor * copy.cell));
    return copy;
}

}  // namespace

std::optional<Layout> climb(const PackTask& task, const ClimbLimits& limits) {
    const int factor = coarseness(task);
    if (factor > 1) {
        const PackTask coarse = coarse_copy(task, factor);
        Climber scout{coarse, first_plans(), limits.most_work};
        run(scout, {limits.start / factor, limits.lowest / factor, limits.highest / factor, limits.most_work});
        if (scout.best) {
            ClimbLimits fine = limits;
            fine.start = std::min(limits.highest, scout.best->texels_per_metre * factor * close);
            // The best of them once more with all poses, since finer texels may favour another.
            scout.successes.push_back(scout.successes[0]);
            scout.successes.back().poses.clear();
            Climber climber{task, scout.successes, limits.most_work};
            run(climber, fine);
            if (climber.best) return std::move(climber.best);
        }
    }
    Climber climber{task, first_plans(), limits.most_work};
    run(climber, limits);
    return std::move(climber.best);
}

}  // namespace surimi
