// SPDX-License-Identifier: Apache-2.0
// Rays between pairs of points, sixteen at a time, and the ratio of what arrives to what is sent.
#pragma once

#include <array>

#include "baker/study/receiver.h"

namespace surimi {

/// The ratio estimator (M6) over pairs that are added one by one.
class ShadowRays {
  public:
    explicit ShadowRays(const StudiedMonitor& light) : light_(light) {}

    /// A pair whose weight is its share of the irradiance.
    void add(const SurfacePoint& from, const LightPoint& to);

    /// A pair of a given weight > 0. `to` may be any place; the ray ends the panel's clearance before its plane.
    void add(const SurfacePoint& from, const LightPoint& to, double weight);

    /// Of all pairs so far. More may follow.
    StudyEstimate estimate();

    /// Sum of the weights of all pairs so far, and of those that see each other.
    double all() const { return all_; }
    double seen();

  private:
    void trace();

    const StudiedMonitor& light_;
    RayPacket packet_;
    std::array<double, RayPacket::capacity> weights_{};
    double all_ = 0, seen_ = 0;
    size_t rays_ = 0;
};

}  // namespace surimi
