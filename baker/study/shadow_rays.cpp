// SPDX-License-Identifier: Apache-2.0
#include "baker/study/shadow_rays.h"

#include <algorithm>
#include <cmath>

namespace surimi {

void ShadowRays::add(const SurfacePoint& from, const LightPoint& to) {
    const double weight = transfer(from, to, light_.sampler.is_two_sided());
    if (weight > 0) add(from, to, weight);
}

void ShadowRays::add(const SurfacePoint& from, const LightPoint& to, double weight) {
    all_ += weight;
    // Light that the shading normal would admit but the surface itself blocks: occluded without a ray.
    if (glm::dot(to.position - from.position, from.geometric_normal) <= 0) return;
    const Vec3 origin = light_.rays.ray_origin(from);
    const double height = std::abs(glm::dot(to.normal, to.position - origin));
    const double clearance = light_.clearance[to.panel];
    const double end = height > clearance ? 1 - clearance / height : 0;
    const Vec3& center = light_.rays.center();
    weights_[packet_.size] = weight;
    packet_.add(origin - center, to.position - center, end);
    if (packet_.size == RayPacket::capacity) trace();
}

void ShadowRays::trace() {
    const uint32_t blocked = packet_.size > 0 ? light_.rays.occluded(packet_, light_.index) : 0;
    for (size_t i = 0; i < packet_.size; ++i)
        if (((blocked >> i) & 1u) == 0) seen_ += weights_[i];
    rays_ += packet_.size;
    packet_.size = 0;
}

double ShadowRays::seen() {
    trace();
    return seen_;
}

StudyEstimate ShadowRays::estimate() {
    trace();
    if (!(all_ > 0)) return {0, rays_, false};
    return {std::clamp(seen_ / all_, 0.0, 1.0), rays_, true};
}

}  // namespace surimi
