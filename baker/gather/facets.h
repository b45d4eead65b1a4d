// SPDX-License-Identifier: Apache-2.0
// The triangles of a scene as one welded mesh, and which of them form one flat facet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/gather/silhouettes.h"
#include "baker/gather/weld.h"

namespace surimi {

struct WeldedMesh {
    std::vector<Vec3f> places;                     ///< of vertices, relative to RayScene::center()
    std::vector<uint8_t> owners;                   ///< of vertices: a monitor, or Edge::ordinary
    std::vector<std::array<uint32_t, 3>> corners;  ///< of triangles: equal places of one owner have one number
    std::vector<FacePlane> planes;                 ///< of triangles; normal 0: no area
};

/// Half-edge 3 t + k runs from corner k of triangle t to the next.
inline uint32_t start_of(const WeldedMesh& mesh, uint32_t half_edge) {
    return mesh.corners[half_edge / 3][half_edge % 3];
}
inline uint32_t end_of(const WeldedMesh& mesh, uint32_t half_edge) {
    return mesh.corners[half_edge / 3][(half_edge + 1) % 3 == 0 ? 0 : half_edge % 3 + 1];
}

/// Plane of a triangle; normal 0 where its area is zero but for rounding.
FacePlane plane_through(const Vec3f& a, const Vec3f& b, const Vec3f& c);

/// All half-edges of triangles with area, sorted so that those of one edge stand together, by number.
std::vector<Keyed> sorted_half_edges(const WeldedMesh& mesh);

/// For each triangle, the one whose plane stands for its facet: the largest of the facet. Flood fill from large to
/// small, so that a plane is always the best there is; a triangle joins when it meets the facet across an edge of two
/// faces that run opposite ways, its normal is within 1e-6 of the standing one, and its corners lie within two
/// half-ulps of the standing plane. Compared with the standing plane, not the neighbour's, facets cannot drift.
std::vector<uint32_t> find_facets(const WeldedMesh& mesh, const std::vector<Keyed>& half_edges);

/// Calls `body(begin, end)` for each edge in [from, to): its half-edges are half_edges[begin, end). An edge belongs to
/// the range in which it begins.
template <class Body>
void for_each_edge(const std::vector<Keyed>& half_edges, size_t from, size_t to, const Body& body) {
    for (size_t begin = from; begin < to; ++begin) {
        if (begin > 0 && half_edges[begin].key == half_edges[begin - 1].key) continue;
        size_t end = begin + 1;
        while (end < half_edges.size() && half_edges[end].key == half_edges[begin].key) ++end;
        body(begin, end);
    }
}

}  // namespace surimi
