// SPDX-License-Identifier: Apache-2.0
#include "baker/study/shadow_map.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

constexpr double near_plane = 0.25;  // of the receiver's depth; nearer blockers are found only where the search is wide

/// The middle of a texel as a depth map sees it.
struct Seen {
    const DepthMap* map = nullptr;
    Vec3 place{0}, normal{0, 0, 1};  // local
};

Seen see(const Receiver& receiver, const DepthMaps& maps) {
    const SurfacePoint point = receiver.surface.sample(0.5, 0.5);
    for (const DepthMap& map : maps) {
        const Vec3 place = map.frame.local(point.position);
        const Vec3& n = point.geometric_normal;
        if (place.z > 0)
            return {&map, place, {glm::dot(n, map.frame.s), glm::dot(n, map.frame.t), glm::dot(n, map.frame.n)}};
    }
    return {};
}

/// Depth of what hides the receiver in a texel of the map; infinite where nothing does.
double blocker_depth(const Seen& seen, int x, int y) {
    const int last = seen.map->size - 1;
    x = std::clamp(x, 0, last);
    y = std::clamp(y, 0, last);
    const Vec3 direction = seen.map->direction(x, y);
    // Where the ray of this texel meets the receiver's plane: nearer than the receiver, it is no blocker but floor.
    const double plane = glm::dot(seen.normal, seen.place) / glm::dot(seen.normal, direction);
    const double limit = plane > 0 ? std::min(plane, seen.place.z) : seen.place.z;
    const double depth = static_cast<double>(seen.map->at(x, y));
    constexpr double bias = 1e-3;  // of the depth; float and the facets of curved receivers
    return depth < limit * (1 - bias) ? depth : INFINITY;
}

/// Blocker depth in the direction of a place in the plane through the receiver that is parallel to the monitor.
double blocker_depth(const Seen& seen, const Vec2& offset) {
    const Vec3 direction = (seen.place + Vec3(offset, 0)) / seen.place.z;
    const Vec2 texel = seen.map->place(direction);
    return blocker_depth(seen, static_cast<int>(texel.x), static_cast<int>(texel.y));
}

/// Calls tap(offset) at `count` places spread evenly over the rectangle of these half sides.
template <class Tap>
void for_each_tap(int count, const Vec2& half_size, const Tap& tap) {
    Vec2 place(0.5);
    for (int i = 0; i < count; ++i) {
        tap(half_size * (2.0 * place - 1.0));
        place = glm::fract(place + Vec2(0.7548776662466927, 0.5698402909980532));  // Roberts' sequence (2018)
    }
}

}  // namespace

DepthMaps make_depth_maps(const StudiedMonitor& light, int size) {
    DepthMaps maps{make_depth_map(light, false, size)};
    if (light.sampler.is_two_sided()) maps.push_back(make_depth_map(light, true, size));
    return maps;
}

StudyEstimate percentage_closer_filter(const Receiver& receiver, const DepthMaps& maps, int n) {
    const Seen seen = see(receiver, maps);
    if (!seen.map) return {};
    const Vec2 texel = seen.map->place(seen.place);
    const int left = static_cast<int>(texel.x) - n / 2, top = static_cast<int>(texel.y) - n / 2;
    int open = 0;
    for (int i = 0; i < n * n; ++i)
        if (!std::isfinite(blocker_depth(seen, left + i % n, top + i / n))) ++open;
    return {static_cast<double>(open) / (n * n), 0, true};
}

StudyEstimate percentage_closer_soft_shadow(const Receiver& receiver, const DepthMaps& maps, int taps) {
    const Seen seen = see(receiver, maps);
    if (!seen.map) return {};
    double sum = 0;
    int blockers = 0;
    for_each_tap(taps, (1 / near_plane - 1) * seen.map->frame.half_size, [&](const Vec2& offset) {
        const double depth = blocker_depth(seen, offset);
        if (std::isfinite(depth)) sum += depth, ++blockers;
    });
    if (blockers == 0) return {1, 0, true};
    const double penumbra = seen.place.z * blockers / sum - 1;  // z_r / z_b - 1 (M59)
    int open = 0;
    for_each_tap(taps, std::min(penumbra, 1 / near_plane - 1) * seen.map->frame.half_size, [&](const Vec2& offset) {
        if (!std::isfinite(blocker_depth(seen, offset))) ++open;
    });
    return {static_cast<double>(open) / taps, 0, true};
}

}  // namespace surimi
