// SPDX-License-Identifier: Apache-2.0
// An atlas: where every triangle of a scene lies on the lightmap, or on the several maps that are its pages.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

/// The uv of one Surface's triangles, in their order. uv is what the file will hold: float, [0, 1], v down, origin at
/// the upper left corner of the page. Multiply by the atlas' size for texels. Both lists are empty for a surface that
/// does not receive: it is nowhere on the map.
struct SurfaceUv {
    std::vector<std::array<Vec2f, 3>> uv;  ///< of the triangle's corners
    std::vector<uint32_t> chart;           ///< index into Atlas::charts
    int page = 0;                          ///< below Atlas::pages: a surface lies wholly on one
};

struct Chart {
    uint32_t surface = 0;         ///< index into Scene::surfaces
    double texels_per_metre = 0;  ///< 0 for charts of zero-area slivers, which have no meaningful density
};

/// Why charts get more or fewer texels per metre than the atlas says.
enum class DensityCause {
    unreached,    ///< no monitor's light can arrive
    far,          ///< far from every monitor
    texel_scale,  ///< the user wants it
    full_page     ///< their surface alone fills a page
};

/// The charts of one surface that one cause gives another density than the atlas'.
struct DensityWeight {
    uint32_t surface = 0;  ///< index into Scene::surfaces
    DensityCause cause = DensityCause::unreached;
    size_t charts = 0;
    double area = 0;         ///< of these charts, square metres
    double area_share = 0;   ///< of the surface's area
    double texel_share = 0;  ///< of the texels inside all charts
    double least = 1;        ///< density over the atlas' density, by this cause alone: of the sparsest chart
    double most = 1;         ///< of the densest
};

/// What is odd about the meshes of a scene as they were cut; nothing of it is an error.
struct MeshCounts {
    size_t components = 0;       ///< parts that hang together across edges
    size_t open_edges = 0;       ///< with one face
    size_t branching_edges = 0;  ///< with more than two: only faces that continue each other stay together
    size_t opposed_edges = 0;    ///< whose two faces have their fronts on different sides, as on a Moebius strip
    size_t doubled_faces = 0;    ///< copies of a face with the same front
    size_t slivers = 0;          ///< faces without a shape to speak of, each with a token of a texel

    void add(const MeshCounts& other) {
        components += other.components;
        open_edges += other.open_edges;
        branching_edges += other.branching_edges;
        opposed_edges += other.opposed_edges;
        doubled_faces += other.doubled_faces;
        slivers += other.slivers;
    }
};

struct Atlas {
    int width = 0;  ///< of every page
    int height = 0;
    int pages = 1;                    ///< maps that the surfaces are spread over; each has a surface
    int gutter = 2;                   ///< empty texels between the touched texels of two charts, at least
    double texels_per_metre = 0;      ///< of charts that nothing weighs
    std::vector<SurfaceUv> surfaces;  ///< one for each Scene::surfaces
    std::vector<Chart> charts;
    std::vector<DensityWeight> weights;  ///< sorted by surface and cause

    bool is_existing = false;           ///< the UVs are the file's own
    MeshCounts meshes;                  ///< of new charts
    std::string uv_reason;              ///< why these UVs, where the choice was left to us; else empty
    std::vector<std::string> warnings;  ///< for the user
};

}  // namespace surimi
