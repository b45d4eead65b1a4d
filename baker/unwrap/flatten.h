// SPDX-License-Identifier: Apache-2.0
// A flattened patch as a chart, in metres and in its tightest box.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/check.h"
#include "baker/unwrap/patch.h"
#include "baker/unwrap/relax.h"

namespace surimi {

/// Connected faces of one surface, laid flat. A sliver is one triangle without a meaningful shape: it has no
/// points and gets a token of about one texel.
struct FlatChart {
    uint32_t surface = 0;
    std::vector<uint32_t> faces;                     ///< triangles of the surface
    std::vector<Vec2> points;                        ///< metres, in the tightest box; its low corner is the origin
    std::vector<std::array<uint32_t, 3>> triangles;  ///< indices into points, for each face; counter-clockwise
    Vec2 extent{0};                                  ///< of the box, metres
    double area = 0;                                 ///< of the faces in space, square metres
    double flat_area = 0;                            ///< of the flat triangles
    double stretch = 1;                              ///< see Distortion
    double need = 0;  ///< room that it takes on a map, square metres: stretched areas want
                      ///< more texels, and its hollows are hard to fill
    bool is_sliver = false;
};

/// The patch with the points of its vertices (in its units, counter-clockwise) turned into the box of least area.
FlatChart make_chart(const FaceGraph& graph, const Patch& patch, const Flattening& flat);

/// For each triangle of a chart the one beyond each edge, or no_face.
std::vector<std::array<uint32_t, 3>> neighbours_of(const FlatChart& chart);

/// The centroids of a chart's triangles, in the plane z = 0.
std::vector<Vec3> centroids_of(const FlatChart& chart);

inline constexpr uint32_t left_out = UINT32_MAX;

/// A chart in parts, each as it lies: one chart for every connected piece of the triangles with the same number in
/// `parts`; those with `left_out` are in none.
std::vector<FlatChart> divide(const FaceGraph& graph, const FlatChart& chart, const std::vector<uint32_t>& parts);

FlatChart make_sliver(uint32_t face);

/// The flat triangles with coordinates rounded to integers, the longer side of the box being `size` long.
std::vector<FlatTriangle> rounded_triangles(const FlatChart& chart, double size);

}  // namespace surimi
