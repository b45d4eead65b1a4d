// SPDX-License-Identifier: Apache-2.0
#include "tests/support/point_rays.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"
#include "runtime/light/sample.h"

namespace surimi::test {

PointRays visibility_by_rays(const Scene& scene, const RayScene& rays, const Obstructed& obstructed, size_t monitor,
                             const SurfacePoint& point, uint32_t count) {
    const MonitorSampler sampler(scene.monitors[monitor]);
    const Vec3 origin = rays.ray_origin(point);
    double all = 0, seen = 0, all_squared = 0, seen_squared = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const auto r = scrambled(sobol::point(i), scrambling(3));
        const LightPoint light = sampler.sample(r[0], r[1]);
        const Vec3 d = light.position - origin;
        const double height = -glm::dot(d, light.normal), cosine = glm::dot(d, point.normal);
        const double emitted = sampler.is_two_sided() ? std::abs(height) : height;
        if (!(emitted > 0 && cosine > 0)) continue;
        const double weight = emitted * cosine / std::pow(glm::dot(d, d), 2);
        all += weight;
        all_squared += weight * weight;
        if (glm::dot(d, point.geometric_normal) <= 0) continue;
        const double end = 1 - obstructed.panels[light.panel].clearance / std::abs(height);
        RayPacket packet;
        packet.add(origin - rays.center(), light.position - rays.center(), end);
        if (end > 0 && rays.occluded(packet, monitor) != 0) continue;
        seen += weight;
        seen_squared += weight * weight;
    }
    if (!(all > 0)) return {0, 1};
    const double v = seen / all;
    return {v, std::sqrt(std::max(0.0, seen_squared * (1 - 2 * v) + all_squared * v * v)) / all};
}

}  // namespace surimi::test
