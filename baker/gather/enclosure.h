// SPDX-License-Identifier: Apache-2.0
// Is a place inside other geometry, by rays (M65)?
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/light/sample.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Tells places inside other geometry from free ones.
class EnclosureJudge {
  public:
    /// Both must outlive it.
    EnclosureJudge(const Scene& scene, const RayScene& rays);

    /// Is the space at the front of `point` inside something? No light of any monitor arrives there, and of the rays
    /// into the hemisphere above it nine in ten come out of something that they never went into. `key` decides the
    /// rays. Costs eight rays a monitor where light arrives.
    bool is_enclosed(const SurfacePoint& point, uint64_t key) const;

    /// Are monitors in free space by the same measure? Where normals point out of the room they are not, and
    /// is_enclosed means nothing.
    bool is_reliable() const;

  private:
    bool sees_monitor(const SurfacePoint& point, uint64_t key) const;

    const Scene& scene_;
    const RayScene& rays_;
    std::vector<MonitorSampler> samplers_;  // of Scene::monitors
};

}  // namespace surimi
