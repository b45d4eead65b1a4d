// SPDX-License-Identifier: Apache-2.0
// What one point of a surface gets from a monitor: by one ray, by splitting or by scanlines.
#pragma once

#include <cstdint>

#include "baker/gather/block_sight.h"
#include "baker/gather/cost.h"
#include "baker/gather/scanline.h"
#include "baker/gather/split.h"

namespace surimi {

struct PointLight {
    double unshadowed = 0;  ///< E (M1), closed form
    double shadowed = 0;    ///< S (M2)
    double error = 0;       ///< estimate of what S / E may be off by
    TexelMethod method = TexelMethod::none;
    size_t rays = 0;
    size_t segments = 0;          ///< silhouettes on the panels
    bool has_near = false;        ///< a shadow that may be narrower than the texel falls on it
    bool is_self_hidden = false;  ///< the shading normal admits light that the point's own triangle blocks
    bool has_failed = false;      ///< a cross-check disagreed: the value is not to be used
    bool is_dear = false;         ///< not evaluated: rays alone are cheaper for the texel

    bool is_usable() const { return !has_failed && !is_dear; }
    double visibility() const { return unshadowed > 0 ? shadowed / unshadowed : 0; }
};

struct PointWorkspace {
    PanelView view;
    Segments segments;
    SplitWorkspace split;
    ScanlineWorkspace scan;
};

struct PointTask {
    uint64_t key = 0;     ///< of the random numbers
    double averaged = 1;  ///< so many points of equal weight are averaged: each may be off by the root of it more
};

/// Points that the monitor does not reach get zeros. Deterministic.
PointLight light_at(const MonitorSetup& setup, const BlockSight& sight, const SurfacePoint& point,
                    const PointTask& task, PointWorkspace& work);

}  // namespace surimi
