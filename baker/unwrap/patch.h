// SPDX-License-Identifier: Apache-2.0
// Some faces of a surface, cut open along seams, as a mesh of their own.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/half_edge.h"

namespace surimi {

/// Which edges of a surface are cut. Flags of corners: 3 * face + k stands for the edge from corner k to k + 1, and
/// both sides of an edge have the same flag. Edges without a face beyond count as cut.
struct SeamFlags {
    explicit SeamFlags(const FaceGraph& graph);

    bool is_cut(uint32_t face, uint32_t k) const { return flags[3 * face + k] != 0; }

    std::vector<uint8_t> flags;
};

/// Cuts or joins the edge, on both sides.
void set_seam(const FaceGraph& graph, uint32_t face, uint32_t k, bool is_cut, SeamFlags& seams);

/// The corner of the face beyond edge k at which the same edge starts there.
uint32_t corner_beyond(const FaceGraph& graph, uint32_t face, uint32_t k);

/// Parts of `faces` that hang together across uncut edges, each sorted by rank, ordered by their first faces' ranks.
/// `number` is scratch of the size of the graph; faces of other calls at the same time have to be others.
std::vector<std::vector<uint32_t>> connected_parts(const FaceGraph& graph, const SeamFlags& seams,
                                                   const std::vector<uint32_t>& faces, std::vector<uint32_t>& number);

struct Patch {
    std::vector<uint32_t> faces;                      ///< of the surface, by rank
    std::vector<std::array<uint32_t, 3>> triangles;   ///< vertices of the patch; the face's first corner first
    std::vector<std::array<uint32_t, 3>> neighbours;  ///< number in `faces` beyond each edge of triangles, or no_face
    std::vector<Vec3> positions;                      ///< of the vertices; the patch has area 1
    std::vector<uint32_t> places;                     ///< of the vertices: index into FaceGraph::positions
    std::vector<std::vector<uint32_t>> loops;         ///< boundary loops as vertices, the patch to their left
    std::vector<std::array<Vec2, 3>> gradients;       ///< of the vertices' hat functions, in each triangle's own frame
    std::vector<double> areas;                        ///< of the triangles; they sum up to 1
    double unit = 1;                                  ///< metres in a unit of length: the square root of the area

    /// V - E + F: 1 and one loop for a disk, 2 for a sphere.
    int euler_characteristic() const;
};

/// `faces`, which hang together and none of which is a sliver, by rank. Vertices are split along the seams, so that
/// each has one fan of triangles and the boundary is made of simple loops. `number` as above; on return it numbers the
/// faces.
Patch build_patch(const FaceGraph& graph, const SeamFlags& seams, std::vector<uint32_t> faces,
                  std::vector<uint32_t>& number);

}  // namespace surimi
