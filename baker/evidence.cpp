// SPDX-License-Identifier: Apache-2.0
#include "baker/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surimi {

std::string name_of(TexelMethod method) {
    switch (method) {
        case TexelMethod::none:
            return "none";
        case TexelMethod::certificate:
            return "certificate";
        case TexelMethod::ray:
            return "ray";
        case TexelMethod::split:
            return "split";
        case TexelMethod::scanline:
            return "scanline";
        case TexelMethod::monte_carlo:
            return "monteCarlo";
    }
    return "none";
}

size_t measured_texels(const GatherStatistics& statistics) {
    size_t sum = 0;
    for (size_t i = 0; i < statistics.methods.size(); ++i)
        if (i != static_cast<size_t>(TexelMethod::none)) sum += statistics.methods[i].texels;
    return sum;
}

EstimatedErrors estimated_errors(const Bake& bake, int channel) {
    EstimatedErrors errors;
    double sum = 0;
    double squares = 0;
    size_t count = 0;
    for (const BakedPage& page : bake.pages) {
        const auto& state = page.state[static_cast<size_t>(channel)].pixels;
        for (size_t i = 0; i < state.size(); ++i) {
            if (state[i] != TexelState::covered) continue;
            const double error = page.irradiance[static_cast<size_t>(channel)].pixels[i].error;
            sum += error;
            squares += error * error;
            errors.largest = std::max(errors.largest, error);
            ++count;
        }
    }
    if (count == 0) return errors;
    errors.mean = sum / static_cast<double>(count);
    errors.rms = std::sqrt(squares / static_cast<double>(count));
    return errors;
}

Audit joined_audit(const std::vector<Audit>& pages) {
    Audit all;
    for (const Audit& page : pages) all.texels += page.texels;
    double mean = 0;  // of squared errors; below and above are the squared distances of the interval's ends from it
    double below = 0;
    double above = 0;
    double reference = 0;
    all.beyond_high = all.texels > 0 ? 0 : 1;
    for (const Audit& page : pages) {
        if (page.texels == 0) continue;
        const double share = static_cast<double>(page.texels) / static_cast<double>(all.texels);
        const double square = page.rmse * page.rmse;
        mean += share * square;
        below += std::pow(share * (square - page.rmse_low * page.rmse_low), 2);
        above += std::pow(share * (page.rmse_high * page.rmse_high - square), 2);
        reference += share * page.reference_error * page.reference_error;
        all.largest = std::max(all.largest, page.largest);
        all.beyond += page.beyond;
        all.beyond_high += share * page.beyond_high;
    }
    all.rmse = std::sqrt(mean);
    all.rmse_low = std::sqrt(std::max(0.0, mean - std::sqrt(below)));
    all.rmse_high = std::sqrt(mean + std::sqrt(above));
    all.reference_error = std::sqrt(reference);
    return all;
}

Promise promise_of(const MonitorEvidence& evidence, double error) {
    Promise promise;
    promise.error = error;
    if (const size_t measured = measured_texels(evidence.statistics); measured > 0)
        promise.share_above = static_cast<double>(evidence.statistics.above_error) / static_cast<double>(measured);
    if (promise.share_above > tolerated_share)
        promise.breaches.push_back(
            fmt::format("{:.2g} % of the texels have an estimated error above {}", 100 * promise.share_above, error));
    const Audit audit = joined_audit(evidence.audits);
    if (static_cast<double>(audit.beyond) > tolerated_share * static_cast<double>(audit.texels))
        promise.breaches.push_back(
            fmt::format("{} of {} audited texels are further off than {}", audit.beyond, audit.texels, error));
    if (audit.rmse_low > error / 2)
        promise.breaches.push_back(
            fmt::format("the audit finds an RMSE of at least {:.2g}, above half of {}", audit.rmse_low, error));
    return promise;
}

}  // namespace surimi
