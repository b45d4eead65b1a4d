// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/time_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "baker/calibration.h"

namespace surimi {
namespace {

/// A short calibration at each of these; between them costs are smooth.
constexpr std::array errors{loosest_error, 0.02, 0.004, 0.001, tightest_error};

/// Upwards to two digits: what is told is what is used.
double round_up(double error) {
    const double digit = std::pow(10.0, std::floor(std::log10(error)) - 1);
    const int digits = static_cast<int>(std::ceil(error / digit * (1 - 1e-9)));
    // By way of text: 31 * 1e-4 is not the number that "0.0031" is.
    return std::stod(fmt::format("{}e{}", digits, std::lround(std::log10(digit))));
}

/// Where a line between the logarithms of both reaches these seconds.
double error_between(const ErrorCost& loose, const ErrorCost& tight, double seconds) {
    const double slope = std::log(tight.seconds / loose.seconds);
    const double share = slope > 0 ? std::log(seconds / loose.seconds) / slope : 1;
    return loose.error * std::pow(tight.error / loose.error, std::clamp(share, 0.0, 1.0));
}

double seconds_between(const ErrorCost& loose, const ErrorCost& tight, double error) {
    const double share = std::log(error / loose.error) / std::log(tight.error / loose.error);
    return loose.seconds * std::pow(tight.seconds / loose.seconds, share);
}

}  // namespace

ErrorChoice choose_error(std::span<const ErrorCost> costs, double seconds) {
    ErrorCost loose{costs[0].error, std::max(costs[0].seconds, 1e-9)};
    if (loose.seconds > seconds) return {loose, false};
    for (const ErrorCost& next : costs.subspan(1)) {
        const ErrorCost tight{next.error, std::max(next.seconds, loose.seconds)};
        if (tight.seconds > seconds) {
            const double error = std::min(round_up(error_between(loose, tight, seconds)), loose.error);
            return {{error, seconds_between(loose, tight, error)}, true};
        }
        loose = tight;
    }
    return {loose, true};
}

std::vector<ErrorCost> measure_costs(const std::function<double(double error)>& seconds_at, double seconds) {
    std::vector<ErrorCost> costs;
    for (const double error : errors) {
        costs.push_back({error, seconds_at(error)});
        if (costs.back().seconds > seconds) break;
    }
    return costs;
}

std::string spend(const Scene& scene, Config& config, const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    GatherSettings& gather = config.bake.gather;
    const Preparation preparation = prepare(scene, config.bake, progress);
    double rest = seconds_of(preparation.costs);  // the bake does it again
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        rest += calibrate_post(scene, preparation, config.bake.post).sum();
        if (config.bake.audit > 0)
            rest += static_cast<double>(config.bake.audit) * calibrate_audit(scene, preparation, m, gather);
    }
    const auto light_seconds = [&](double error) {
        double seconds = 0;
        gather.error = error;
        for (size_t m = 0; m < scene.monitors.size(); ++m)
            seconds += calibrate(scene, preparation, m, gather, progress).seconds;
        return seconds;
    };
    const std::vector<ErrorCost> costs = measure_costs(light_seconds, config.seconds - rest - elapsed());
    const double spent = elapsed();
    const ErrorChoice choice = choose_error(costs, config.seconds - rest - spent);
    gather.error = choice.chosen.error;
    const double predicted = choice.chosen.seconds + rest + spent;
    return fmt::format("--time {}: error {} (predicted {:.3g} s, {:.2g} s of them for the choice){}\n", config.seconds,
                       gather.error, predicted, spent,
                       choice.fits ? "" : "; no error takes less, so the time is exceeded");
}

}  // namespace surimi
