// SPDX-License-Identifier: Apache-2.0
// What a monitor's centre sees: depths over its half space, for shadows without rays (Williams 1978).
#pragma once

#include <vector>

#include "baker/study/receiver.h"

namespace surimi {

/// One side of a monitor as one flat light: the rectangle around all of its panels.
struct MonitorFrame {
    Vec3 center{0};                           ///< mean of the panels by area, world space
    Vec3 s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};  ///< unit, perpendicular; n points to the side that is looked at
    Vec2 half_size{0};                        ///< metres along s and t

    /// Coordinates along s, t, n from the centre.
    Vec3 local(const Vec3& place) const {
        const Vec3 d = place - center;
        return {glm::dot(d, s), glm::dot(d, t), glm::dot(d, n)};
    }
};

/// The frame of the front, or of the back.
MonitorFrame frame_of(const Monitor& monitor, bool is_back);

/// Square, over the half space in front of the frame, by the half of an octahedron (Engelhardt and Dachsbacher 2008):
/// no frustum covers 180 degrees.
struct DepthMap {
    MonitorFrame frame;
    int size = 0;
    std::vector<float> depth;  ///< metres along n to what is seen first, row by row; infinite where nothing is

    /// Local direction with n = 1 through the middle of a texel.
    Vec3 direction(int x, int y) const;
    /// Where a local direction, n > 0, lies: texel coordinates in [0, size]^2.
    Vec2 place(const Vec3& direction) const;
    float at(int x, int y) const {
        return depth[static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x)];
    }
};

/// size * size rays from just in front of the centre; the monitor's own surfaces are not seen. One thread. Alpha-masked
/// holes let rays through.
DepthMap make_depth_map(const StudiedMonitor& light, bool is_back, int size);

}  // namespace surimi
