// SPDX-License-Identifier: Apache-2.0
// Places the primitives of a glTF file's meshes in the world: nodes and primitives -> Surfaces.
#pragma once

#include "runtime/scene/gltf_document.h"

namespace surimi {

/// Makes scene.surfaces for every node of scene.nodes that is in the scene and has a mesh. Mirrored nodes get
/// their triangles turned, skinned meshes are placed by their joints, normals are repaired or made, triangles
/// without area dropped. Throws Error(scene) for data that read_primitive refuses and for positions that are
/// not finite.
void make_surfaces(const GltfDocument& document, Scene& scene);

/// Is the triangle too thin to have a direction? Area <= 1e-14 * longest edge^2: the cross product of two
/// edges in double is off by about 1e-16 * longest edge^2, so that a smaller area would leave its normal
/// fewer than two digits.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

/// Normals under a linear map: the cofactor matrix with the determinant's sign, which is the inverse
/// transpose times a positive factor where that exists, and still right where the map flattens one direction.
Mat3 normal_matrix(const Mat3& linear);

}  // namespace surimi
