// SPDX-License-Identifier: Apache-2.0
// What a bake knows about its own error, and whether that is what was asked for.
#pragma once

#include <string>
#include <vector>

#include "baker/bake.h"

namespace surimi {

/// The share of a monitor's measured texels that may be further off than the error asked for.
inline constexpr double tolerated_share = 0.001;

/// "none", "certificate", "ray", "split", "scanline", "monteCarlo": as files have it.
std::string name_of(TexelMethod method);

/// Texels that got light: all but those of TexelMethod::none.
size_t measured_texels(const GatherStatistics& statistics);

/// The estimated standard errors of V over a channel's covered texels, all pages together. Zeros without such texels.
struct EstimatedErrors {
    double mean = 0;
    double rms = 0;
    double largest = 0;
};
EstimatedErrors estimated_errors(const Bake& bake, int channel);

/// The audits of several pages as one: texels and counts add up, squared errors are averaged by texels, the distances
/// of the interval's ends from them added in quadrature (pages are drawn independently), upper bounds of shares
/// averaged, which is on the safe side. A page without audited texels has no say.
Audit joined_audit(const std::vector<Audit>& pages);

/// Whether a monitor's channel is what was asked for.
struct Promise {
    double error = 0;                   ///< asked for
    double share_above = 0;             ///< of measured texels, by their estimates
    std::vector<std::string> breaches;  ///< what speaks against it, in words; empty: it is kept

    bool is_kept() const { return breaches.empty(); }
};

/// It is broken when more than `tolerated_share` of the texels have an estimate above `error`, when more than that of
/// the audited ones are beyond it, or when the audit's interval for the RMSE lies above half of it.
Promise promise_of(const MonitorEvidence& evidence, double error);

}  // namespace surimi
