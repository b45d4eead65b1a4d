// SPDX-License-Identifier: Apache-2.0
// Points on a monitor that are even in solid angle, as seen from a place.
#pragma once

#include <vector>

#include "runtime/light/monitor.h"
#include "runtime/light/sample.h"

namespace surimi {

/// A monitor seen from one place: triangles that together are all panels whose emitting side it sees.
class SeenMonitor {
  public:
    SeenMonitor(const Monitor& monitor, const Vec3& from);

    /// Steradian; at most 2 pi a panel.
    double solid_angle() const { return sum_; }

    /// The point for (u, v) in [0, 1)^2, even in solid angle when (u, v) are (Arvo 1995). Undefined when solid_angle()
    /// is 0. `weight` is the solid angle it stands for.
    LightPoint sample(double u, double v, double& weight) const;

  private:
    struct Triangle {
        double cumulative = 0, solid_angle = 0;
        Vec3 a{0}, b{0}, c{0};  // corners relative to the place
        Vec3 normal{0, 0, 1};
        size_t panel = 0;
    };
    Vec3 from_;
    std::vector<Triangle> triangles_;
    double sum_ = 0;
};

}  // namespace surimi
