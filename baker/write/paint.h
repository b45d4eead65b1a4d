// SPDX-License-Identifier: Apache-2.0
// Triangles and lines of an atlas -> pixels.
#pragma once

#include <algorithm>
#include <cmath>

#include "baker/unwrap/coverage.h"
#include "baker/unwrap/raster.h"
#include "runtime/base/image.h"

namespace surimi {

/// Gives every pixel that triangle i touches `value(i)`, the triangle that covers its centre before all others.
template <class Pixel, class Value>
void paint(const PlacedTriangles& placed, const Value& value, Image<Pixel>& image) {
    for (const double reach : {0.5, 0.0})
        for (size_t i = 0; i < placed.texels.size(); ++i)
            visit_runs(placed.texels[i], reach, {image.width, 0, image.height}, [&](int row, int first, int last) {
                std::fill_n(&image.at(first, row), last - first + 1, value(i));
            });
}

/// A line of pixels from one place to another, in pixels, which may lie on the ends of the picture.
template <class Pixel>
void draw_line(const Vec2& from, const Vec2& to, const Pixel& color, Image<Pixel>& picture) {
    const Vec2 way = to - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::max(std::abs(way.x), std::abs(way.y)))));
    for (int i = 0; i <= steps; ++i) {
        const glm::ivec2 p = glm::ivec2(glm::floor(from + way * (static_cast<double>(i) / steps)));
        // A side at the map's end belongs to the last pixel.
        picture.at(std::clamp(p.x, 0, picture.width - 1), std::clamp(p.y, 0, picture.height - 1)) = color;
    }
}

}  // namespace surimi
