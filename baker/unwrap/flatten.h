// SPDX-License-Identifier: Apache-2.0
// Faces -> a flat chart by orthographic projection, and the ways to take a chart apart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/check.h"
#include "baker/unwrap/half_edge.h"

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
    bool is_sliver = false;
};

/// Projects along the faces' area-weighted mean normal and turns the result into its box of least area.
FlatChart flatten(const FaceGraph& graph, std::vector<uint32_t> faces);

FlatChart make_sliver(uint32_t face);

/// The flat triangles with coordinates rounded to integers, the longer side of the box being `size` long.
std::vector<FlatTriangle> rounded_triangles(const FlatChart& chart, double size);

/// Cuts connected faces in two connected halves, each face going to the seed (number within `faces`) that is
/// nearer along the surface.
std::array<std::vector<uint32_t>, 2> split_between(const FaceGraph& graph, const std::vector<uint32_t>& faces,
                                                   std::array<uint32_t, 2> seeds);

/// The connected parts of some faces, ordered by their first face.
std::vector<std::vector<uint32_t>> connected_parts(const FaceGraph& graph, const std::vector<uint32_t>& faces);

}  // namespace surimi
