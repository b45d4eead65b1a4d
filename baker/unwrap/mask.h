// SPDX-License-Identifier: Apache-2.0
// An outline -> the texels that it touches and encloses, one bit each, and their runs and squares.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/unwrap/check.h"

namespace surimi {

/// Touched texels of a chart.
struct Mask {
    struct Run {
        int row = 0;
        int begin = 0;
        int length = 0;
        bool operator==(const Run&) const = default;
    };
    struct Square {
        int x = 0;  ///< of its low corner
        int y = 0;
        int level = 0;  ///< its side is 2^level
    };
    static constexpr int most_level = 6;

    int width = 0;
    int height = 0;
    size_t texels = 0;
    std::vector<Run> runs;        ///< sorted by row, then by x
    std::vector<Square> squares;  ///< one or two of the largest squares in the mask, up to 2^most_level wide
    int turns = 0;                ///< see turned()
    int shape = 0;                ///< for who tries several axes of a chart: which one this is
};

/// A mask with x put as width - x, y as height - y, or both.
Mask flipped(const Mask& mask, bool in_x, bool in_y);

class Raster {
  public:
    /// All texels untouched.
    Raster(int width, int height);

    /// Touches the texels whose open square, grown by `slack` to all sides, meets the edge, and counts it as part of
    /// the outline.
    void add_edge(const Vec2& a, const Vec2& b, double slack);

    /// Touches the texels whose centre lies within the closed outline of all edges so far (an odd number of times).
    void fill();

    /// One texel for each square of `cell` texels a side, which divides width and height.
    Raster cells(int cell) const;

    Mask mask() const;

  private:
    using Word = uint64_t;

    size_t row(int y) const { return static_cast<size_t>(y) * words_; }
    void touch_run(int y, int begin, int end);
    Raster squares(int half) const;
    void add_squares(Mask& mask) const;

    int width_;
    int height_;
    size_t words_;  ///< in a row
    std::vector<Word> bits_;
    std::vector<Word> crossings_;  ///< texels whose centre has an odd number of edges to the left that the next has not
};

}  // namespace surimi
