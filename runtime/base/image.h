// SPDX-License-Identifier: Apache-2.0
// A rectangle of pixels in memory, top row first. No file formats here: see runtime/image.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace surimi {

template <class Pixel>
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Pixel> pixels;  ///< row-major, top row first; width * height of them

    Image() = default;
    Image(int w, int h, const Pixel& value = Pixel{})
        : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h), value) {}

    size_t index(int x, int y) const {
        assert(x >= 0 && x < width && y >= 0 && y < height);
        return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    }
    Pixel& at(int x, int y) { return pixels[index(x, y)]; }
    const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }
    bool empty() const { return pixels.empty(); }
};

}  // namespace surimi
