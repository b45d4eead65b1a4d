// SPDX-License-Identifier: Apache-2.0
#include "baker/study/receiver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surimi {
namespace {

/// As baker/gather/panel.h defines it; said again here so that a reference does not depend on what it judges.
double clearance_of(const Polygon& panel, const Vec3& center) {
    double diameter = 0, magnitude = 0;
    for (const Vec3& a : panel.corners) {
        for (const Vec3& b : panel.corners) diameter = std::max(diameter, glm::length(a - b));
        for (int c = 0; c < 3; ++c) magnitude = std::max(magnitude, std::abs(a[c] - center[c]));
    }
    constexpr double half_ulp = 0.5 * std::numeric_limits<float>::epsilon();
    return 1e-4 * diameter + 64 * half_ulp * magnitude;
}

}  // namespace

StudiedMonitor::StudiedMonitor(const Scene& s, const RayScene& r, size_t i)
    : scene(s), rays(r), index(i), sampler(s.monitors[i]) {
    for (const Polygon& panel : monitor().panels) clearance.push_back(clearance_of(panel, rays.center()));
}

double transfer(const SurfacePoint& from, const LightPoint& to, bool is_two_sided) {
    const Vec3 d = to.position - from.position;
    const double r2 = glm::dot(d, d);
    const double receiver = glm::dot(d, from.normal);
    const double emitter = is_two_sided ? std::abs(glm::dot(d, to.normal)) : -glm::dot(d, to.normal);
    if (!(receiver > 0) || !(emitter > 0)) return 0;
    return receiver * emitter / (r2 * r2);
}

}  // namespace surimi
