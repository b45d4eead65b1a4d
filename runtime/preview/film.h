// SPDX-License-Identifier: Apache-2.0
// A picture in the making: sums over the samples so far, added to tile by tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/preview/render.h"

namespace surimi {

/// What has been summed up, pixel by pixel.
struct Film {
    Image<Vec3> sum;
    Image<float> roughness;         ///< sum over the samples that show a surface
    Image<uint16_t> rough_samples;  ///< how many those are
    Image<uint8_t> is_surface;      ///< some sample shows one
    Film(int width, int height)
        : sum(width, height, Vec3(0)),
          roughness(width, height),
          rough_samples(width, height),
          is_surface(width, height) {}
};

/// A rectangle of a film: a work item.
struct Tile {
    int x0, y0, width, height;
};

/// A batch of about a thousand points, whose arrays fit the second-level cache.
inline constexpr int tile_size = 32;

/// Tiles of `size` pixels along a side that cover a film, row by row; none for a film without pixels.
std::vector<Tile> tiles_of(int width, int height, int size = tile_size);

/// What is taken, and how it is divided into pixels.
struct Shot {
    const Lighting& lighting;
    View view;
    Show show = Show::lit;
    Vec2 pixels{1};  ///< width and height of the picture in pixels of the film; need not be whole
};

/// One sample of every pixel.
struct Pass {
    Vec2 offset{0.5};  ///< of the sample in its pixel
    uint64_t key = 0;  ///< of its random numbers
};

/// Pass number `pass` of samples_per_side squared. Early ones spread over the pixel.
Pass pass_of(const RenderSettings& settings, int pass);

/// Adds one sample of every pixel of a tile: rays first, then all points that they see in one batch. Tiles of one film
/// may be added at a time. `counts`, one for each monitor, is added to.
void add_tile(const Shot& shot, const Pass& pass, const Tile& tile, Film& film, std::span<MonitorCounts> counts);

/// The means of a film with `passes` samples in every pixel; `counts` stays empty.
Picture develop(const Film& film, int passes);

}  // namespace surimi
