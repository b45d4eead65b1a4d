// SPDX-License-Identifier: Apache-2.0
// The taken texels of a map, and where a mask still fits.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/unwrap/footprint.h"

namespace surimi {

/// A mask with what the search for a place needs.
struct Template {
    /// Texels of a row, 2^level of them.
    struct Block {
        int x = 0;
        int y = 0;
        int level = 0;
    };
    int width = 0;
    int height = 0;
    std::vector<Mask::Square> squares;  ///< of the mask: they rule most places out
    std::vector<Block> runs;            ///< cover the mask row by row, in an order that finds collisions early
    Mask::Run longest;                  ///< run
};

Template make_template(const Mask& mask);

/// One bit for each texel, and for every power of two the bits "one of the next 2^k texels of the row is taken" and
/// "one texel of the square of 2^k is taken": so a run or a square of any place in a row is tested against a whole
/// row of places with one shift.
class Occupancy {
  public:
    explicit Occupancy(const MapSize& map);

    const MapSize& size() const { return map_; }

    /// The first x at which the mask, its lowest row at `y`, meets no taken texel; -1 when there is none. Moves the run
    /// that ruled out the last place forward: it is likely to do so on the next row too.
    int first_free(Template& mask, int y);

    /// Takes the mask's texels and those within `gutter` of them (in x, y or both), clipped to the map.
    void take(const Mask& mask, int x, int y, int gutter);

    /// Words of 64 places that were looked at so far: a measure of time that is the same on every machine.
    uint64_t work() const { return work_; }

    static constexpr int square_levels = Mask::most_level + 1;
    static constexpr int run_levels = 9;  ///< runs up to 256 texels in one step; longer ones in several

  private:
    using Word = uint64_t;

    /// Rows and words that change: the levels above follow.
    struct Range {
        size_t first_word = 0;
        size_t last_word = 0;
        int low = 0;
        int high = 0;
    };

    size_t place(int level, int row) const {
        return (static_cast<size_t>(level) * static_cast<size_t>(map_.height) + static_cast<size_t>(row)) * words_;
    }
    void block(const Word* bits, int offset, size_t first, size_t last);
    bool narrow(size_t& first, size_t& last) const;
    void take_run(int row, int begin, int end);
    void refresh(std::vector<Word>& bits, int level, int rise, const Range& range);
    void refresh_largest(int low, int high);
    void refresh_longest(int low, int high);

    MapSize map_;
    size_t words_;                 ///< in a row
    std::vector<Word> runs_;       ///< level, row, word
    std::vector<Word> squares_;    ///< level, row, word
    std::vector<int8_t> largest_;  ///< of each row: the largest k with a free square of 2^k standing on it; -1 for none
    std::vector<int> longest_;     ///< of each row: the most free texels side by side
    std::vector<Word> blocked_;
    uint64_t work_ = 0;
};

}  // namespace surimi
