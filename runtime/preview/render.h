// SPDX-License-Identifier: Apache-2.0
// Camera rays -> picture: a scene lit by its monitors through the visibility map.
#pragma once

#include "runtime/base/parallel.h"
#include "runtime/map/visibility_map.h"
#include "runtime/preview/camera.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

enum class Show {
    lit,         ///< albedo / pi times shadowed irradiance in the monitors' colours, plus emission
    visibility,  ///< V of the three monitors as R, G, B
    unshadowed,  ///< E / pi of the three monitors as R, G, B
    shadowed,    ///< V E / pi
    uv,          ///< lightmap coordinates as R, G
    texels,      ///< lightmap texels as a checker, coloured by place
    normals,     ///< (n + 1) / 2
};

struct RenderSettings {
    int width = 1280;
    int height = 720;
    int samples_per_side = 3;  ///< of a pixel: anti-aliasing by a grid of this many squared
    Show show = Show::lit;
};

struct Picture {
    Image<Vec3f> pixels;      ///< linear; lit: nits
    double lit_share = 0;     ///< share of the pixels that show a surface which is lit and does not emit
    double bright_level = 0;  ///< 95th percentile of the luminance of surfaces that do not emit; 0 when none is lit
};

/// Back faces of single-sided materials are not seen, as in engines; blended ones are mixed in.
Picture render(const Scene& scene, const VisibilityMap& map, const RayScene& rays, const View& view,
               const RenderSettings& settings, const Progress& progress);

/// Filmic curve (Narkowicz 2015) of linear * exposure, in [0, 1], still linear. Monotone; NaN becomes 0.
double filmic(double x);

/// Display pixels: filmic and sRGB for `lit`, sRGB alone for everything else.
Image<glm::u8vec3> to_display(const Picture& picture, Show show, double exposure);

/// Exposure that brings the picture's bright level to 0.7 before the curve.
double automatic_exposure(const Picture& picture);

/// A view inside the scene that shows much lit surface and a monitor: the best of a fixed set of candidates in front
/// of the monitors, judged by tiny pictures. Deterministic.
View frame_automatically(const Scene& scene, const VisibilityMap& map, const RayScene& rays, double aspect);

}  // namespace surimi
