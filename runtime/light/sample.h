// SPDX-License-Identifier: Apache-2.0
// Points on a monitor, evenly by area.
#pragma once

#include <vector>

#include "runtime/light/monitor.h"

namespace surimi {

struct LightPoint {
    Vec3 position{0};
    Vec3 normal{0, 0, 1};  ///< unit, front side
    size_t panel = 0;      ///< index into Monitor::panels
};

/// A monitor cut into pieces over which a point is affine in (u, v): parallelograms where panels are such, else
/// triangles.
class MonitorSampler {
  public:
    explicit MonitorSampler(const Monitor& monitor);

    /// The point for (u, v) in [0, 1)^2; evenly spread over the panels' area when (u, v) are.
    LightPoint sample(double u, double v) const;

    /// A sampler of the part where dot(normal, place) >= height, and of some more around it; the same sampler where
    /// that is all or nothing.
    MonitorSampler above(const Vec3& normal, double height) const;

    double area() const { return area_; }
    bool is_two_sided() const { return two_sided_; }

  private:
    struct Piece {
        double cumulative = 0;  // area of this and all earlier pieces, m^2
        bool is_parallelogram = false;
        Vec3 origin{0}, edge_u{0}, edge_v{0}, normal{0, 0, 1};
        size_t panel = 0;
    };
    void add(Piece piece);

    std::vector<Piece> pieces_;
    double area_ = 0;
    bool two_sided_ = false;
};

}  // namespace surimi
