// SPDX-License-Identifier: Apache-2.0
// What monitors and other surfaces emit, as the scene says it.
#pragma once

#include "runtime/light/lit_monitor.h"
#include "runtime/scene/surface_point.h"

namespace surimi {

/// The scene's monitors as it describes them: their radiance, and the emissive texture of their material as picture,
/// placed by its texture coordinates, where it has one.
std::vector<LitMonitor> lit_monitors(const Scene& scene);

/// An 8-bit image, sRGB-encoded, as linear colours.
Image<Vec3f> linear_image(const Image<glm::u8vec4>& image);

/// Radiance that a monitor emits at a place on one of its panels.
Vec3 monitor_emission(const Monitor& monitor, const LitMonitor& light, const Vec3& position);

/// Radiance that a surface emits at a point seen from its front: a monitor's as it shines now, else the material's.
Vec3 emission(const Scene& scene, const std::vector<LitMonitor>& lights, const SurfacePoint& at);

}  // namespace surimi
