// SPDX-License-Identifier: Apache-2.0
// Triangle meshes that are easy, and meshes that break unwrappers, made by formulas; and scenes of them.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
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

/// Adds such a surface as a node of its own; returns the index.
uint32_t add_surface(Scene& scene, const std::string& name, const Mesh& mesh);

Mesh scaled(Mesh mesh, double factor);
/// Triangle i of the result is triangle order[i].
Mesh reordered(const Mesh& mesh, const std::vector<size_t>& order);
/// The numbers below `count` in an order that only `seed` decides.
std::vector<size_t> shuffled_order(size_t count, uint32_t seed);

// Discs. Each can be one chart.
Mesh terrain(int cells);                  ///< height field of 10 m, cells x cells, rough at five scales
Mesh arch(int across, int along);         ///< 270 degrees of a cylinder: flattens without stretch
Mesh dome(int rings, int spokes);         ///< most of a hemisphere, with a small hole in its top
Mesh cloth(int along, int across);        ///< a sheet folded so far that it overhangs
Mesh helix(int turns, int cells_a_turn);  ///< a long flat strip, above itself in every projection
Mesh signed_zeros();                      ///< a sheet of two halves that meet at x = 0.0 and x = -0.0

// Closed.
Mesh uv_sphere(int segments, int rings);  ///< triangles of zero area at the poles are left in
Mesh ico_sphere(int subdivisions);        ///< 20 * 4^subdivisions triangles
Mesh torus(int segments, int rings);
Mesh box(const Vec3& center, const Vec3& size);
Mesh capped_cylinder(int segments);

// Not manifold, not orientable, not clean.
Mesh book();              ///< three pages on one spine, two of them at 12 degrees
Mesh moebius();           ///< a strip of one side
Mesh walls();             ///< a floor with turned and doubled triangles, and two walls that cross upon its inner edges
Mesh touching_cubes();    ///< cubes that share a face, an edge, a corner
Mesh mixed_winding();     ///< a height field with every fourth triangle turned
Mesh degenerate_grid();   ///< with repeated indices, zero areas, needles and T junctions
Mesh needle_fan();        ///< slim triangles around one point, some of 1e-7 radians
Mesh foliage(int quads);  ///< separate small quads in all directions

struct NamedMesh {
    const char* name;
    Mesh (*make)();
};
inline std::ostream& operator<<(std::ostream& out, const NamedMesh& mesh) {
    return out << mesh.name;
}

/// All of the above, in sizes that a sanitised build can handle.
const std::vector<NamedMesh>& all_meshes();

}  // namespace surimi::test
