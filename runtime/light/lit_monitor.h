// SPDX-License-Identifier: Apache-2.0
// A monitor as it shines at the moment: colour, intensity, picture. None of it changes the map.
#pragma once

#include <optional>

#include "runtime/light/picture.h"

namespace surimi {

/// In the order of Scene::monitors.
struct LitMonitor {
    Vec3 radiance{1};  ///< linear RGB, nits; colour times intensity
    std::optional<MonitorPicture> picture;
};

/// Does it shine at all?
inline bool is_lit(const LitMonitor& light) {
    return light.radiance != Vec3(0);
}

/// Radiance that leaves a place on a panel.
inline Vec3 radiance_at(const LitMonitor& light, size_t panel, const Vec3& position) {
    return light.picture ? light.radiance * picture_at(*light.picture, panel, position) : light.radiance;
}

struct MonitorHit {
    double distance = 0;  ///< in lengths of the ray's direction
    size_t panel = 0;
    bool is_front = true;
};

/// Every panel that a ray meets, in the order of the panels, whatever stands before them: a monitor does not shade
/// itself.
std::vector<MonitorHit> hits_of(const Monitor& monitor, const Vec3& origin, const Vec3& direction);

}  // namespace surimi
