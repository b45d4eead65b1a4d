// SPDX-License-Identifier: Apache-2.0
// Camera rays -> picture: a scene lit by its monitors.
#pragma once

#include <functional>

#include "runtime/base/parallel.h"
#include "runtime/preview/camera.h"
#include "runtime/shade/shade.h"

namespace surimi {

enum class Show {
    lit,         ///< what the eye sees: reflected light and emission, nits
    diffuse,     ///< reflected by the Lambert part
    specular,    ///< reflected by the GGX part
    visibility,  ///< V of the three monitors as R, G, B
    unshadowed,  ///< E / pi of the three monitors as R, G, B
    shadowed,    ///< V E / pi
    uv,          ///< lightmap coordinates as R, G
    texels,      ///< lightmap texels as a checker, coloured by place
    normals,     ///< (n + 1) / 2, with normal maps
    roughness,   ///< perceptual, grey
};

struct RenderSettings {
    int width = 1280;
    int height = 720;
    int samples_per_side = 3;  ///< of a pixel: anti-aliasing by a grid of this many squared
    Show show = Show::lit;
    uint64_t seed = 0;  ///< of stochastic shading; the grid is always the same
    bool operator==(const RenderSettings&) const = default;
};

struct Picture {
    Image<Vec3f> pixels;      ///< linear; lit views: nits
    Image<float> roughness;   ///< of what the pixel shows, its mean; -1 where nothing reflects
    double lit_share = 0;     ///< share of the pixels that show a surface which is lit and does not emit
    double bright_level = 0;  ///< 95th percentile of the luminance of surfaces that do not emit; 0: none is lit
    std::vector<MonitorCounts> counts;  ///< what was computed for each monitor
};

/// Back faces of single-sided materials are not seen, as in engines; blended ones are mixed in. The picture comes in
/// passes of one sample for every pixel; `on_pass`, if given, gets what there is after each, and how many of how many.
Picture render(const Lighting& lighting, const View& view, const RenderSettings& settings, const Progress& progress,
               const std::function<void(const Picture&, int pass, int passes)>& on_pass = {});

/// A view inside the scene that shows much lit surface and a monitor: the best of a fixed set of candidates in front
/// of the monitors, judged by tiny pictures, which are shaded by the closed forms and the map whatever the settings
/// are. Deterministic.
View frame_automatically(const Lighting& lighting, double aspect);

}  // namespace surimi
