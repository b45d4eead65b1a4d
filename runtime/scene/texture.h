// SPDX-License-Identifier: Apache-2.0
// What a material's textures say at a point of a surface.
#pragma once

#include "runtime/scene/surface_point.h"

namespace surimi {

/// Bilinear lookup of a texture as a material uses it, as stored (not linearised), in [0, 1]; white where the material
/// has no such texture, its image could not be decoded, or the surface lacks the uv set.
Vec4 look_up_texture(const Scene& scene, const TextureUse& use, const SurfacePoint& at);

/// The same of a texture of sRGB-encoded colours, linearised before it is filtered; alpha as stored.
Vec4 look_up_color_texture(const Scene& scene, const TextureUse& use, const SurfacePoint& at);

/// The alpha that decides whether a point of a surface is there: factor times texture.
double alpha_at(const Scene& scene, const Material& material, const SurfacePoint& at);

/// glTF's default material, for surfaces without one.
const Material& material_of(const Scene& scene, const Surface& surface);

/// Is the surface alpha-masked, so that light may come through holes?
bool is_cutout(const Scene& scene, const Surface& surface);

}  // namespace surimi
