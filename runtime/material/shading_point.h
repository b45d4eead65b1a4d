// SPDX-License-Identifier: Apache-2.0
// A point as shading sees it: where it is, where the eye is, and what the material's textures say there.
#pragma once

#include "runtime/scene/surface_point.h"

namespace surimi {

/// All colours linear. The model is glTF's metallic-roughness: a Lambert part and a GGX part (M30).
struct ShadingPoint {
    SurfacePoint at;         ///< its normals on the side that is seen
    Vec3 normal{0, 0, 1};    ///< unit, with the normal map
    Vec3 view{0, 0, 1};      ///< unit, towards the eye
    Vec3 diffuse_albedo{0};  ///< before the share that the surface reflects is taken off
    Vec3 f0{0.04};           ///< reflectance at normal incidence
    double roughness = 1;    ///< perceptual, in [0, 1]
    uint64_t key = 0;        ///< of the random numbers that stochastic methods use at this point
    bool is_unlit = false;   ///< KHR_materials_unlit: shows `diffuse_albedo` whatever shines on it
};

/// Reads the material at a surface point seen from the direction `view` (unit, towards the eye). Normal maps are in the
/// tangent space that the texture coordinates span (glTF without TANGENT); where they span none, the map is left out.
ShadingPoint shading_point(const Scene& scene, const SurfacePoint& at, const Vec3& view);

/// F0 of a material whose base colour is `base_color`, metallic in [0, 1]: the dielectric's from its index of
/// refraction (KHR_materials_ior, KHR_materials_specular), the metal's base colour.
Vec3 reflectance_at_normal_incidence(const Material& material, const Vec3& base_color, double metallic);

/// Can the material reflect a highlight anywhere? False for unlit ones, and for dielectrics whose F0 is 0.
bool is_specular(const Material& material);

}  // namespace surimi
