// SPDX-License-Identifier: Apache-2.0
// One primitive of a glTF mesh in its own space: vertices and triangles, before any node places it.
#pragma once

#include "runtime/scene/gltf_document.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surimi {

/// A joint of the primitive's skin and how much it moves a vertex.
struct Influence {
    uint32_t joint = 0;
    double weight = 0;
};

struct PrimitiveData {
    std::string place;                       ///< "mesh 3 (Chair), primitive 1"
    std::vector<Vec3> positions;             ///< finite; morph targets applied
    std::vector<Vec3> normals;               ///< as the file has them, perhaps neither unit nor finite; empty: none
    std::vector<std::vector<Vec2>> uv_sets;  ///< finite
    std::vector<std::array<uint32_t, 3>> triangles;  ///< strips and fans expanded; in range; may be degenerate
    size_t influences_per_vertex = 0;                ///< 0: not skinned
    std::vector<Influence> influences;               ///< influences_per_vertex for each vertex
};

/// Reads primitive `primitive` of mesh `mesh` with the morph targets at `weights` (missing ones are 0).
/// Points, lines and primitives without positions have no triangles. What was repaired or skipped goes to
/// `notes`. Throws Error(scene) for accessors of the wrong type or length, indices out of range and infinite
/// positions.
PrimitiveData read_primitive(const GltfDocument& document, size_t mesh, size_t primitive,
                             const std::vector<double>& weights, std::vector<Note>& notes);

}  // namespace surimi
