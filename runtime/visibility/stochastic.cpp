// SPDX-License-Identifier: Apache-2.0
#include "runtime/visibility/stochastic.h"

#include <algorithm>

#include "runtime/base/random.h"

namespace surimi {

Vec3 stochastic_visibility(const Scene& scene, const RayScene& rays, size_t monitor, const LitMonitor& light,
                           const MonitorSampler& sampler, const ShadingPoint& point, int samples) {
    const DirectLight estimate =
        direct_light(scene, rays, monitor, light, sampler, point, samples, true, hash(point.key, monitor));
    const Vec3 all = estimate.unshadowed.sum(), arriving = estimate.shadowed.sum();
    Vec3 ratio(1);
    for (int c = 0; c < 3; ++c)
        if (all[c] > 0) ratio[c] = std::clamp(arriving[c] / all[c], 0.0, 1.0);
    return ratio;
}

}  // namespace surimi
