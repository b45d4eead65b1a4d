// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/climb.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstdio>

#include "runtime/base/error.h"

namespace surimi {
int env(const char* name, int otherwise);
int env(const char* name, int otherwise) { const char* v = getenv(name); return v ? atoi(v) : otherwise; }
namespace {

constexpr size_t kept_successes = 3;
constexpr double least_step = 1.002;
constexpr double most_step = 1.03;

void tell(const FitRequest& request, double fraction) {
    if (request.progress.is_cancelled && request.progress.is_cancelled())
        throw Error(ErrorKind::interrupted, "interrupted while packing");
    if (request.progress.report) request.progress.report("packing", fraction);
}

void remember(Attempt& attempt, const std::vector<PackPlan>& plans, Climb& climb) {
    PackPlan plan = plans[attempt.winner];
    plan.poses = attempt.layout->poses;
    climb.successes.insert(climb.successes.begin(), std::move(plan));
    if (climb.successes.size() > kept_successes) climb.successes.pop_back();
    climb.best = std::move(attempt.layout);
}

/// How many times smaller the copy is: its charts still have a few dozen texels across on average.
int coarseness(const PackTask& task) {
    const double texels = static_cast<double>(task.map.width) * task.map.height;
    const double across = std::sqrt(texels / static_cast<double>(task.request.charts.size()));
    const double least_across = env("ACROSS", 20);
    constexpr int least_side = 128;
    int factor = 1;
    while (across / (2 * factor) >= least_across && std::min(task.map.width, task.map.height) / (2 * factor) >= least_side)
        factor *= 2;
    return factor;
}

std::vector<PackPlan> first_plans(size_t charts) {
    std::vector<PackPlan> plans;
    const int bits = charts > 500 ? env("PLANSB", 5) : env("PLANS", 255);
    int i = 0;
    for (PackRule rule : {PackRule::centre, PackRule::upper_end})
        for (const PackOrder order : {PackOrder::longer_side, PackOrder::half_perimeter, PackOrder::box, PackOrder::texels})
            if (bits >> i++ & 1) plans.push_back({order, rule, {}, {}});
    return plans;
}

}  // namespace

Climb climb(const PackTask& task, std::vector<PackPlan> plans, const ClimbLimits& limits) {
    Climb result;
    uint64_t work = 0;
    int attempts = 0;
    for (double density = limits.start; !result.best && density > limits.lowest; density *= limits.fall) {
        tell(task.request, 0);
        Attempt first = attempt(task, density, plans, false);
        work += first.work; ++attempts;
        if (first.layout) remember(first, plans, result);
        if (!first.layout && density * limits.fall <= limits.lowest) {
            first = attempt(task, limits.lowest, plans, false);
            if (first.layout) remember(first, plans, result);
            return result;
        }
    }
    double step = 1 + 0.5 * (1 / limits.fall - 1);
    for (int failures = 0; work < limits.most_work || failures < 2;) {
        tell(task.request, std::min(1.0, static_cast<double>(work) / static_cast<double>(limits.most_work + 1)));
        Attempt next = attempt(task, result.best->texels_per_metre * step, plans, true);
        work += std::max<uint64_t>(next.work, limits.most_work / 2000); ++attempts;
        if (next.layout) {
            remember(next, plans, result);
            step = std::min(most_step, 1 + 1.5 * (step - 1));
            failures = 0;
        } else {
            failures += step == least_step;
            step = std::max(least_step, 1 + 0.5 * (step - 1));
        }
    }
    if (env("SHOW", 0)) fprintf(stderr, "map %d: density %.5g attempts %d work %.1f M\n", task.map.width, result.best->texels_per_metre, attempts, static_cast<double>(work) * 1e-6);
    return result;
}

Climb climb_coarse_to_fine(const PackTask& task, const ClimbLimits& limits) {
    const int factor = coarseness(task);
    std::vector<PackPlan> plans = first_plans(task.request.charts.size());
    if (factor == 1) return climb(task, std::move(plans), limits);
    PackTask coarse = task;
    coarse.map = {task.map.width / factor, task.map.height / factor};
    coarse.cell = std::max(1, task.cell / factor);
    coarse.gutter = std::max(1, (task.gutter * task.cell + factor / 2) / (factor * coarse.cell));
    ClimbLimits coarse_limits = limits;
    coarse_limits.start /= factor;
    coarse_limits.lowest /= factor;
    const Climb learned = climb(coarse, std::move(plans), coarse_limits);
    if (!learned.best) return climb(task, first_plans(task.request.charts.size()), limits);
    plans = learned.successes;
    if (env("FREE", 0)) {
    plans.push_back(plans[0]);
    plans.back().poses.clear();
    }
    ClimbLimits fine = limits;
    fine.start = learned.best->texels_per_metre * factor;
    fine.fall = 0.99;
    return climb(task, std::move(plans), fine);
}

}  // namespace surimi
