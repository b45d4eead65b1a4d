// SPDX-License-Identifier: Apache-2.0
// The light of monitors on points: analytic diffuse and specular, times visibility.
#pragma once

#include <optional>
#include <span>

#include "runtime/batch/batch.h"
#include "runtime/light/sample.h"
#include "runtime/map/visibility_map.h"
#include "runtime/material/brdf.h"
#include "runtime/shade/plan.h"
#include "runtime/shade/textured.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Where shadows come from.
enum class VisibilitySource {
    none,        ///< nothing is shadowed
    baked,       ///< the map
    stochastic,  ///< the ratio of two sums over the same few rays (M32)
};

/// How the shares of a monitor's light are computed.
enum class ShadingModel {
    exact,      ///< closed forms, cut at the horizons, both lobes, coupled to the diffuse part (M30)
    kanikama,   ///< as Kanikama's shader: clipless, horizon by a table of spheres, one lobe, nothing coupled
    three,      ///< as three.js' RectAreaLight: clipless, horizon by a rational fraction, one lobe, nothing coupled
    reference,  ///< brute force (M31), from as many samples as the stochastic source
};

struct LightingSettings {
    VisibilitySource visibility = VisibilitySource::baked;
    ShadingModel model = ShadingModel::exact;
    Precision precision = Precision::mixed;
    int picture_cells = 4;                           ///< along each side of a panel that shows a picture
    int samples = 16;                                ///< of each technique, point and monitor, where rays are traced
    std::optional<double> roughness = std::nullopt;  ///< of every surface, perceptual, in [0, 1]; empty: its own
    bool operator==(const LightingSettings&) const = default;
};

/// A scene with its lights as they shine now. Refers to its parts; they must outlive it.
struct Lighting {
    Lighting(const Scene& scene, const std::vector<VisibilityMap>& pages, const RayScene& rays,
             std::vector<LitMonitor> lights, const LightingSettings& settings);

    const Scene& scene;
    const std::vector<VisibilityMap>& pages;  ///< the maps of a bake; empty: none
    const RayScene& rays;
    std::vector<LitMonitor> lights;
    LightingSettings settings;
    ShadingPlan plan;
    std::vector<MonitorSampler> samplers;
    std::vector<std::vector<LightPiece>> pieces;  ///< of each monitor: cells where it shows a picture, else panels
};

/// Gives a monitor another radiance (linear, nits), which costs nothing; its picture stays.
void set_radiance(Lighting& lighting, size_t monitor, const Vec3& radiance);

/// Radiance, in nits, that points reflect to the eye of all monitors. `reflected` has the points' length and is
/// written; `counts`, one for each monitor, is added to. Unlit points get their colour as diffuse.
void shade(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
           std::span<MonitorCounts> counts);

}  // namespace surimi
