// SPDX-License-Identifier: Apache-2.0
// Visibility of a monitor from a point by many single rays.
#pragma once

#include "tests/support/triangle_subtraction.h"

namespace surimi::test {

struct PointRays {
    double visibility = 0;
    double error = 1;  ///< standard error that independent samples would have; Sobol points do better
};

/// The ratio estimator over `count` Owen-scrambled Sobol points of the monitor.
PointRays visibility_by_rays(const Scene& scene, const RayScene& rays, const Obstructed& obstructed, size_t monitor,
                             const SurfacePoint& point, uint32_t count);

}  // namespace surimi::test
