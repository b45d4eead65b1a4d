// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/evidence_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "baker/evidence.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

std::ptrdiff_t count(const Bake& bake, const Monitor& monitor, TexelState which) {
    std::ptrdiff_t sum = 0;
    for (const BakedPage& page : bake.pages) {
        const auto& state = page.state[static_cast<size_t>(monitor.channel)].pixels;
        sum += std::count(state.begin(), state.end(), which);
    }
    return sum;
}

/// " (31 % by certificate, 40 % by one ray)": the methods that were used.
std::string shares_of_methods(const GatherStatistics& statistics) {
    constexpr std::array phrases{"", "by certificate", "by one ray", "split", "by scanlines", "by Monte Carlo"};
    static_assert(phrases.size() == texel_method_count);
    const double all = static_cast<double>(measured_texels(statistics));
    std::vector<std::string> parts;
    for (size_t i = 1; i < phrases.size(); ++i) {
        const double percent = 100 * static_cast<double>(statistics.methods[i].texels) / all;
        if (percent > 0) parts.push_back(fmt::format("{:.{}f} % {}", percent, percent < 1 ? 2 : 0, phrases[i]));
    }
    return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", "));
}

std::string audit_phrase(const std::vector<Audit>& audits, double error) {
    const Audit audit = joined_audit(audits);
    if (audit.texels == 0) return "";
    return fmt::format("; audit of {}: RMSE {:.2g} ({:.2g} to {:.2g}), {} beyond {}", audit.texels, audit.rmse,
                       audit.rmse_low, audit.rmse_high, audit.beyond, error);
}

std::string title(const Monitor& monitor) {
    return fmt::format("{} {}", "RGB"[monitor.channel], monitor.name);
}

}  // namespace

std::string percent_within(double share_above) {
    return fmt::format("{:.4g} %", std::floor((1 - share_above) * 1e4) / 100);
}

void print_evidence(const Scene& scene, const Bake& bake) {
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Monitor& monitor = scene.monitors[m];
        const MonitorEvidence& evidence = bake.evidence[m];
        fmt::print(stderr, "{}: {} texels measured{}, {} unlit, {} filled, {} empty\n", title(monitor),
                   count(bake, monitor, TexelState::covered), shares_of_methods(evidence.statistics),
                   count(bake, monitor, TexelState::unlit), count(bake, monitor, TexelState::filled),
                   count(bake, monitor, TexelState::empty));
        const Promise promise = promise_of(evidence, bake.error);
        fmt::print(stderr, "  estimated error: {} within {}, RMS {:.2g}{}\n", percent_within(promise.share_above),
                   promise.error, estimated_errors(bake, monitor.channel).rms,
                   audit_phrase(evidence.audits, promise.error));
        if (!promise.is_kept())
            fmt::print(stderr, "warning: {}: the error asked for is not reached: {}\n", title(monitor),
                       fmt::join(promise.breaches, "; "));
    }
}

void require_promises(const Scene& scene, const Bake& bake) {
    std::string missed;
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Promise promise = promise_of(bake.evidence[m], bake.error);
        if (!promise.is_kept())
            missed += fmt::format("{}{}: {}", missed.empty() ? "" : "; ", title(scene.monitors[m]),
                                  fmt::join(promise.breaches, "; "));
    }
    if (missed.empty()) return;
    throw Error(ErrorKind::target_missed,
                missed + "; the files are written; --exact, or --method auto without --samples, comes closer");
}

}  // namespace surimi
