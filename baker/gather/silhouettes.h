// SPDX-License-Identifier: Apache-2.0
// The edges at which a scene can begin or cease to hide something: welded, with the planes of their faces, in a tree.
// Seen from a point, the number of surfaces in front of a monitor changes across such edges only (M50).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/scene/scene.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// The plane n.x = d of all coplanar faces that meet across edges, unit normal on the side that their winding shows.
struct FacePlane {
    Vec3 normal{0, 0, 1};
    double distance = 0;
};

/// 32 bytes. The first face runs from a to b along the edge. Coordinates are those that Embree sees: float, relative
/// to RayScene::center().
struct Edge {
    static constexpr uint32_t no_plane = 0x7fffffffu;
    static constexpr uint32_t ordinary = 3;  ///< owner of what is no monitor

    Vec3f a{0}, b{0};
    uint32_t first_and_owner = 0;   ///< plane of the first face; above it two bits: the monitor it belongs to, or 3
    uint32_t second_and_sense = 0;  ///< plane of the second or no_plane; top bit: that face runs from a to b as well

    uint32_t first() const { return first_and_owner & 0x3fffffffu; }
    uint32_t owner() const { return first_and_owner >> 30; }
    uint32_t second() const { return second_and_sense & 0x7fffffffu; }
    bool has_second() const { return second() != no_plane; }
    bool runs_alike() const { return (second_and_sense >> 31) != 0; }
};

/// Of a tree in depth-first order: the left child follows its parent.
struct EdgeNode {
    Vec3f low{0}, high{0};
    Vec3f axis{0};       ///< of a cone that holds the normals of all faces at the edges below, if there is one
    float cosine = -2;   ///< of the cone's half angle; -2: no cone (a boundary edge, or normals all around)
    uint32_t first = 0;  ///< leaf: its edges are edges[first, first + count); inner node: the right child
    uint32_t count = 0;  ///< 0: inner node
};

/// At most 80 bytes for each edge of the scene, tree and planes included (a test holds it to that).
struct Silhouettes {
    Vec3 center{0};  ///< of the scene; what places here are relative to
    std::vector<FacePlane> planes;
    std::vector<Edge> edges;      ///< in the tree's order; flat ones, between faces of one plane, are left out
    std::vector<EdgeNode> nodes;  ///< empty without edges
    /// [surface][triangle], as Hit and TriangleRef count them: surfaces.size() + m is the panels of monitor m, empty
    /// where it has a surface. Edge::no_plane for triangles without area, alpha-masked ones, and those that do not
    /// cast.
    std::vector<std::vector<uint32_t>> plane_of;
    std::vector<EdgeNode> cutout_nodes;         ///< tree over alpha-masked triangles: bounds only; no cones
    std::vector<std::array<Vec3f, 3>> cutouts;  ///< those triangles in that tree's order
};

/// All edges of opaque surfaces that cast (blended and transmissive ones are opaque here, as for rays). Surfaces of
/// different owners are not welded to each other. Faces are merged into one plane when they meet across an edge, their
/// normals differ by less than 1e-6 and every vertex lies within rounding of the plane that stands for the group. An
/// edge of three faces or more is one record for each of them. Monitors without a surface contribute their panels.
/// Parallel; the result does not depend on the number of threads.
Silhouettes find_silhouettes(const Scene& scene, const RayScene& rays);

/// The same over given edges, which keep their planes' numbers: for what a panel's plane cuts off (panel.h).
void build_tree(Silhouettes& silhouettes);

/// The convex hull of a block of receivers and a panel, as the planes that bound it.
struct Shaft {
    struct Plane {
        Vec3 normal{0, 0, 1};  ///< unit; inside is normal.x + offset >= 0
        double offset = 0;
    };
    std::vector<Plane> planes;
    Vec3 low{0}, high{0};            ///< bounds
    std::vector<Vec3> block, panel;  ///< the corners it was made of
    Vec3 block_center{0};
    double block_radius = 0;
    double margin = 0;  ///< by how much planes and bounds were moved out
};

/// `block`: corners of a convex volume that holds the receivers, 1 to 8, may be flat or a point. `panel`: corners of a
/// planar convex polygon. Both relative to Silhouettes::center. Planes are moved out by rounding of `scale`, the
/// largest coordinate: the shaft holds the hull, never less.
Shaft make_shaft(std::span<const Vec3> block, std::span<const Vec3> panel, double scale);

/// Indices into `edges` of all edges that meet the shaft, belong to another than `monitor`, and can be a silhouette
/// from some point of the block (not all planes at it seen from the same side by the whole block, M50). In tree order;
/// what `found` held before is gone.
void find_candidates(const Silhouettes& silhouettes, const Shaft& shaft, size_t monitor, std::vector<uint32_t>& found);

/// Does an edge of this plane's group, silhouette or not, meet the shaft? Where none does, the plane has the block on
/// one side and the panel on the other, and one ray between them hits the group, it hides all from all (M51).
bool meets_rim(const Silhouettes& silhouettes, const Shaft& shaft, uint32_t plane);

/// May an alpha-masked triangle meet the shaft? By the triangle's bounds and corners: true more often than it does.
bool meets_cutout(const Silhouettes& silhouettes, const Shaft& shaft);

}  // namespace surimi
