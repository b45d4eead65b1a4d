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
/// the upper left corner of the page. Multiply by the atlas' size for texels.
struct SurfaceUv {
    std::vector<std::array<Vec2f, 3>> uv;  ///< of the triangle's corners
    std::vector<uint32_t> chart;           ///< index into Atlas::charts
    int page = 0;                          ///< below Atlas::pages: a surface lies wholly on one
};

struct Chart {
    uint32_t surface = 0;         ///< index into Scene::surfaces
    double texels_per_metre = 0;  ///< 0 for charts of zero-area slivers, which have no meaningful density
};

/// A surface that got fewer texels per metre than the rest, and why.
struct DensityCap {
    uint32_t surface = 0;
    double factor = 1;  ///< its density over the atlas' density, below 1
    std::string reason;
};

struct Atlas {
    int width = 0;  ///< of every page
    int height = 0;
    int pages = 1;                    ///< maps that the surfaces are spread over; each has a surface
    int gutter = 2;                   ///< empty texels between the touched texels of two charts, at least
    double texels_per_metre = 0;      ///< of charts that were not capped
    std::vector<SurfaceUv> surfaces;  ///< one for each Scene::surfaces
    std::vector<Chart> charts;
    std::vector<DensityCap> caps;

    bool is_existing = false;           ///< the UVs are the file's own
    std::string uv_reason;              ///< why these UVs, where the choice was left to us; else empty
    std::vector<std::string> warnings;  ///< for the user
};

}  // namespace surimi
