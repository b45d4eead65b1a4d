// SPDX-License-Identifier: Apache-2.0
// Triangle meshes as bare positions and indices, and scenes made of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi::test {

struct Mesh {
    std::vector<Vec3> positions;  ///< metres
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// One surface a mesh, with the vertices as they are and normals averaged by area. Zero-area triangles are left out,
/// as the loader does.
Scene scene_of(const std::vector<Mesh>& meshes);

}  // namespace surimi::test
