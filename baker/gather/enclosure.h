// SPDX-License-Identifier: Apache-2.0
// Is a place inside other geometry, by rays (M65)?
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/light/sample.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

enum class Enclosure {
    free,          ///< light arrives, or one can look away
    behind_sheet,  ///< dark, and much of what it sees is the back of single-sided faces, but of none close by
    enclosed       ///< inside something, outside the room, behind a single-sided face close by, or in a crevice
};

/// Tells places inside other geometry from free ones. Where any of eight rays to a monitor arrives a place is free.
class EnclosureJudge {
  public:
    /// Both must outlive it. Costs some rays from the monitors.
    EnclosureJudge(const Scene& scene, const RayScene& rays);

    /// Of the space at the front of `point`. `texel_size`, metres, is what counts as close by; `key` decides the rays.
    Enclosure judge(const SurfacePoint& point, double texel_size, uint64_t key) const;

    /// The same for the back of a two-sided surface: what is closed encloses it, though it is two-sided.
    Enclosure judge_back(const SurfacePoint& turned_point, double texel_size, uint64_t key) const;

    /// Are monitors in free space by the same measure? Where normals point out of the room they are not, and
    /// nothing can be judged.
    bool is_reliable() const { return is_reliable_; }

  private:
    struct Probe {
        double texel_size = 0;
        uint64_t key = 0;
        bool meets_sheets = false;
    };
    Enclosure judge(const SurfacePoint& point, const Probe& probe) const;
    void look_from_monitors();
    bool sees_monitor(const SurfacePoint& point, uint64_t key) const;
    bool is_single_sided(uint32_t surface) const;

    const Scene& scene_;
    const RayScene& rays_;
    std::vector<MonitorSampler> samplers_;  // of Scene::monitors
    bool is_reliable_ = true;
    // No walk from the monitors finds out of the scene: who sees out of it is outside of the room.
    bool is_closed_ = false;
};

}  // namespace surimi
