// SPDX-License-Identifier: Apache-2.0
// A scene with the engine's view of it beside the oracle's, random points of its surfaces, and statistics of what lies
// between the two.
#pragma once

#include <string>
#include <vector>

#include "baker/gather/gather.h"
#include "tests/support/random.h"
#include "tests/support/triangle_subtraction.h"

namespace surimi::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool is_slow_build = true;
#else
inline constexpr bool is_slow_build = false;
#endif
/// A number of cases, or fewer with sanitizers.
constexpr int cases(int count) {
    return is_slow_build ? (count + 9) / 10 : count;
}

/// IrradianceEstimate is float: a ratio of two of them is off by up to this.
inline constexpr double float_ratio = 0x1p-23;

/// Shadowed over unshadowed; 0 where there is no light.
double visibility_of(const IrradianceEstimate& estimate);

class VisibilityJudge {
  public:
    explicit VisibilityJudge(Scene scene);

    const Scene& scene() const { return scene_; }
    const RayScene& rays() const { return rays_; }
    const Silhouettes& silhouettes() const { return silhouettes_; }

    SubtractedIrradiance truth(const SurfacePoint& point, size_t monitor = 0) const;
    /// The engine's, by splitting.
    double split(const SurfacePoint& point, size_t monitor = 0) const;
    /// The engine's, by scanlines.
    double scanline(const SurfacePoint& point, double error, size_t monitor = 0) const;

    /// Does a ray from there start on another surface, so that rounding decides on which side of it?
    bool is_ambiguous(const SurfacePoint& point) const;

    /// As Embree sees a vertex: float relative to the scene's centre. In the scene's coordinates.
    Vec3 seen(const Vec3& vertex) const;
    /// A point above which rays start exactly at `origin`, on the front of triangle 0 of `surface`.
    SurfacePoint point_below(uint32_t surface, const Vec3& origin) const;

  private:
    Scene scene_;
    RayScene rays_;
    Silhouettes silhouettes_;
    std::vector<Obstructed> obstructed_;  ///< by monitor
};

/// On a random triangle of a random surface that is no monitor. The shading normal leans away from the geometric one by
/// up to about 60 degrees times `tilt`, in [0, 1].
SurfacePoint random_point(const Scene& scene, Choice& choice, double tilt);

/// Absolute errors.
class Deviations {
  public:
    std::vector<double> errors;
    int penumbra = 0;  ///< of them where neither nothing nor all is seen

    std::string worst;  ///< where, and what it was and should be

    void add(double value, double truth, const SurfacePoint& where);
    double rmse() const;
    double largest() const;
    /// The error that this share of them does not exceed.
    double quantile(double share) const;

  private:
    double most_ = 0;
};

}  // namespace surimi::test
