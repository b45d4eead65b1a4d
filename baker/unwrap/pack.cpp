// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/pack.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace surimi {
namespace {

using Word = uint64_t;

int bit_count(int value) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(value)));
}

/// The taken texels of the map, one bit each, and for every power of two the bits "one of the next 2^k texels
/// is taken": so a run of any length is tested against a whole row of positions with two shifts.
class Occupancy {
  public:
    explicit Occupancy(const MapSize& map)
        : width_(map.width), height_(map.height), words_(static_cast<size_t>(map.width + 63) / 64) {
        levels_ = std::min(most_levels, bit_count(width_));
        bits_.assign(static_cast<size_t>(levels_) * static_cast<size_t>(height_) * words_, 0);
        free_level_.assign(static_cast<size_t>(height_), levels_ - 1);
    }

    size_t words() const { return words_; }

    /// Adds to `blocked` the positions x where the run, moved to x, hits a taken texel of `row`.
    void block(int row, int begin, int length, std::vector<Word>& blocked) const {
        const int level = std::min(levels_, bit_count(length)) - 1;
        const int step = 1 << level;
        const Word* bits = level_row(level, row);
        for (int offset = begin;; offset += step) {
            const int start = std::min(offset, begin + length - step);
            shift_into(bits, start, blocked);
            if (start == begin + length - step) return;
        }
    }

    /// Whether no run of `length` texels is free in this row. May say no when it is so.
    bool has_no_room(int row, int length) const {
        return free_level_[static_cast<size_t>(row)] < bit_count(length) - 1 &&
               free_level_[static_cast<size_t>(row)] < levels_ - 1;
    }

    /// Marks a run in a row; both are clipped to the map. `refresh` has to follow.
    void take(int row, int begin, int end) {
        if (row < 0 || row >= height_) return;
        begin = std::max(begin, 0);
        end = std::min(end, width_);
        Word* bits = level_row(0, row);
        for (int x = begin; x < end;) {
            const int in_word = x & 63;
            const int count = std::min(64 - in_word, end - x);
            const Word ones = count == 64 ? ~Word{0} : ((Word{1} << count) - 1);
            bits[x >> 6] |= ones << in_word;
            x += count;
        }
    }

    void refresh(int first_row, int last_row) {
        for (int row = std::max(0, first_row); row <= std::min(height_ - 1, last_row); ++row) {
            int free = width_ > 0 && has_zero(level_row(0, row), width_) ? 0 : -1;
            for (int level = 1; level < levels_; ++level) {
                const Word* below = level_row(level - 1, row);
                Word* bits = level_row(level, row);
                std::copy(below, below + words_, bits);
                shift_into(below, 1 << (level - 1), bits);
                if (free == level - 1 && has_zero(bits, width_ - (1 << level) + 1)) free = level;
            }
            free_level_[static_cast<size_t>(row)] = free;
        }
    }

    static bool has_zero(const Word* bits, int count) { return first_zero(bits, count) >= 0; }

    /// Index of the first zero among the first `count` bits, or -1.
    static int first_zero(const Word* bits, int count) {
        for (int i = 0; i * 64 < count; ++i) {
            if (~bits[i] == 0) continue;
            const int at = i * 64 + std::countr_one(bits[i]);
            return at < count ? at : -1;
        }
        return -1;
    }

  private:
    static constexpr int most_levels = 9;  ///< runs up to 256 in one step; longer ones in several

    Word* level_row(int level, int row) {
        return bits_.data() +
               (static_cast<size_t>(level) * static_cast<size_t>(height_) + static_cast<size_t>(row)) * words_;
    }
    const Word* level_row(int level, int row) const { return const_cast<Occupancy*>(this)->level_row(level, row); }

    void shift_into(const Word* bits, int offset, std::vector<Word>& target) const {
        shift_into(bits, offset, target.data());
    }

    /// target |= bits >> offset, over the whole row.
    void shift_into(const Word* bits, int offset, Word* target) const {
        const size_t skip = static_cast<size_t>(offset) / 64;
        const int shift = offset & 63;
        if (skip >= words_) return;
        const size_t count = words_ - skip;
        if (shift == 0) {
            for (size_t i = 0; i < count; ++i) target[i] |= bits[i + skip];
            return;
        }
        for (size_t i = 0; i + 1 < count; ++i)
            target[i] |= (bits[i + skip] >> shift) | (bits[i + skip + 1] << (64 - shift));
        target[count - 1] |= bits[words_ - 1] >> shift;
    }

    int width_;
    int height_;
    int levels_ = 1;
    size_t words_;
    std::vector<Word> bits_;       ///< level, row, word
    std::vector<int> free_level_;  ///< of each row: the largest k with 2^k free texels side by side, -1 for none
};

/// A mask with what the search needs: its runs, the telling ones first.
struct Template {
    const Mask* mask = nullptr;
    std::vector<Mask::Run> runs;  ///< in an order that finds collisions early
    int longest = 0;
    int longest_row = 0;
};

Template make_template(const Mask& mask) {
    Template t;
    t.mask = &mask;
    for (const Mask::Run& run : mask.runs) {
        if (run.length <= t.longest) continue;
        t.longest = run.length;
        t.longest_row = run.row;
    }
    // First every 2^n-th run of the list, then those between: spread over the mask, so that the blocked
    // positions fill up after a few rows.
    const size_t count = mask.runs.size();
    size_t step = std::bit_ceil(count);
    t.runs.reserve(count);
    if (count > 0) t.runs.push_back(mask.runs[0]);
    for (; step > 1; step /= 2)
        for (size_t i = step / 2; i < count; i += step) t.runs.push_back(mask.runs[i]);
    return t;
}

class Packer {
  public:
    Packer(const MapSize& map, int gutter) : map_(map), gutter_(gutter), taken_(map), blocked_(taken_.words()) {}

    bool place(const std::vector<Mask>& masks, Placement& result) {
        // A chart of the same size failed on all rows below the last one's, and the map only fills up.
        int& hint = hint_[{std::max(masks[0].width, masks[0].height), std::min(masks[0].width, masks[0].height)}];
        std::tuple<int, int> best{INT32_MAX, INT32_MAX};  // upper end, x
        for (int turns = 0; turns < static_cast<int>(masks.size()); ++turns) {
            const Template t = make_template(masks[static_cast<size_t>(turns)]);
            const int last = std::min(map_.height - t.mask->height, std::get<0>(best) - t.mask->height);
            for (int y = hint; y <= last; ++y) {
                const int x = first_free(t, y);
                if (x < 0) continue;
                if (std::tuple<int, int>{y + t.mask->height, x} < best) {
                    best = {y + t.mask->height, x};
                    result = {x, y, turns};
                }
                break;
            }
        }
        if (std::get<0>(best) == INT32_MAX) return false;
        hint = result.y;
        take(masks[static_cast<size_t>(result.turns)], result);
        return true;
    }

  private:
    int first_free(const Template& t, int y) {
        const int positions = map_.width - t.mask->width + 1;
        if (positions <= 0 || taken_.has_no_room(y + t.longest_row, t.longest)) return -1;
        std::fill(blocked_.begin(), blocked_.end(), 0);
        constexpr size_t look_every = 4;  // runs between two looks whether any position is left
        size_t next_look = look_every;
        for (size_t i = 0; i < t.runs.size(); ++i) {
            const Mask::Run& run = t.runs[i];
            taken_.block(y + run.row, run.begin, run.length, blocked_);
            if (i + 1 < next_look) continue;
            if (!Occupancy::has_zero(blocked_.data(), positions)) return -1;
            next_look = i + 1 + look_every;
        }
        return Occupancy::first_zero(blocked_.data(), positions);
    }

    /// Takes the mask and the gutter around it: later charts are then tested with their bare masks.
    void take(const Mask& mask, const Placement& at) {
        for (const Mask::Run& run : mask.runs)
            for (int row = run.row - gutter_; row <= run.row + gutter_; ++row)
                taken_.take(at.y + row, at.x + run.begin - gutter_, at.x + run.begin + run.length + gutter_);
        taken_.refresh(at.y - gutter_, at.y + mask.height - 1 + gutter_);
    }

    MapSize map_;
    int gutter_;
    Occupancy taken_;
    std::vector<Word> blocked_;
    std::map<std::array<int, 2>, int> hint_;
};

/// What "largest first" means. No order wins on all scenes: thin strips want the longer side, hollow frames
/// the box.
enum class Order { longer_side, half_perimeter, box };

int64_t size_under(Order order, const Mask& mask) {
    switch (order) {
        case Order::longer_side:
            return std::max(mask.width, mask.height);
        case Order::half_perimeter:
            return mask.width + mask.height;
        default:
            return static_cast<int64_t>(mask.width) * mask.height;
    }
}

std::vector<uint32_t> sort_charts(const std::vector<std::vector<Mask>>& charts, Order order) {
    std::vector<uint32_t> sorted(charts.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    const auto key = [&](uint32_t i) {
        const Mask& m = charts[i][0];
        return std::make_tuple(-size_under(order, m), -std::max(m.width, m.height), -std::min(m.width, m.height),
                               -static_cast<int64_t>(m.texels), i);
    };
    std::sort(sorted.begin(), sorted.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    return sorted;
}

}  // namespace

std::optional<std::vector<Placement>> pack(const std::vector<std::vector<Mask>>& charts, const MapSize& map,
                                           int gutter) {
    for (const Order order : {Order::longer_side, Order::half_perimeter, Order::box}) {
        Packer packer(map, gutter);
        std::vector<Placement> placements(charts.size());
        const std::vector<uint32_t> sorted = sort_charts(charts, order);
        const auto place = [&](uint32_t i) { return packer.place(charts[i], placements[i]); };
        if (std::all_of(sorted.begin(), sorted.end(), place)) return placements;
    }
    return std::nullopt;
}

double least_texels(const std::vector<std::vector<Mask>>& charts, int gutter) {
    // Charts grown by the gutter to the right and upwards only are still disjoint. Every column of a
    // connected mask then has `gutter` texels more, and so has every row.
    double sum = 0;
    for (const auto& masks : charts) {
        const Mask& m = masks[0];
        sum += static_cast<double>(m.texels) + static_cast<double>(gutter) * (m.width + m.height + gutter);
    }
    return sum;
}

}  // namespace surimi
