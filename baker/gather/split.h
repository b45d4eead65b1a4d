// SPDX-License-Identifier: Apache-2.0
// Exact visibility from a point: the panel cut along all silhouettes, one ray for each fragment.
#pragma once

#include <cstddef>
#include <vector>

#include "baker/gather/panel.h"
#include "baker/gather/segments.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

struct PointVisibility {
    double visibility = 0;  ///< in [0, 1]
    double error = 0;       ///< estimate of what it may be off by
    size_t rays = 0;
    bool is_consistent = true;  ///< false: cross-check rays contradict the silhouettes; the value is not to be used
};

/// Memory that is used again from point to point.
struct SplitWorkspace {
    struct Segment {
        Vec2 a, b;
    };
    struct Fragment {
        double weight;
        Vec2 middle;
    };
    std::vector<Segment> segments;  ///< a stack: every call's list on top of its caller's
    std::vector<Vec2> corners;      ///< a stack of polygons
    std::vector<Fragment> fragments;
};

/// No silhouette ends inside a fragment, so the number of occluders is constant there and one ray through its middle
/// decides (M53). Fragments below 1e-12 of the whole are dropped.
PointVisibility split(const PanelView& view, const Segments& segments, const RayScene& rays, size_t monitor,
                      SplitWorkspace& work);

}  // namespace surimi
