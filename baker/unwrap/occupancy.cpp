// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/occupancy.h"

#include <algorithm>
#include <bit>

namespace surimi {
namespace {

/// The largest k with 2^k <= value.
int log_of(int value) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(value))) - 1;
}

/// Blocks of 2^level side by side from `begin` on over `length` texels, the last one moved back to end with them.
void cover(int begin, int length, int y, int level, std::vector<Template::Block>& blocks) {
    const int step = 1 << level;
    for (int offset = 0;; offset += step) {
        const int start = std::min(offset, length - step);
        blocks.push_back({begin + start, y, level});
        if (start == length - step) return;
    }
}

}  // namespace

Template make_template(const Mask& mask) {
    Template t;
    t.width = mask.width;
    t.height = mask.height;
    t.squares = mask.squares;
    // First every 2^n-th run of the list, then those between: spread over the mask, so that places are ruled out
    // after a few rows.
    const size_t count = mask.runs.size();
    const auto add_run = [&](const Mask::Run& run) {
        cover(run.begin, run.length, run.row, std::min(Occupancy::run_levels - 1, log_of(run.length)), t.runs);
    };
    t.runs.reserve(2 * count);
    add_run(mask.runs[0]);
    for (const Mask::Run& run : mask.runs)
        if (run.length > t.longest.length) t.longest = run;
    for (size_t step = std::bit_ceil(count); step > 1; step /= 2)
        for (size_t i = step / 2; i < count; i += step) add_run(mask.runs[i]);

    return t;
}

Occupancy::Occupancy(const MapSize& map) : map_(map), words_(static_cast<size_t>(map.width + 63) / 64) {
    runs_.assign(place(run_levels, 0), 0);
    squares_.assign(place(square_levels, 0), 0);
    largest_.assign(static_cast<size_t>(map.height), square_levels - 1);
    longest_.assign(static_cast<size_t>(map.height), map.width);
    blocked_.resize(words_);
    refresh_largest(0, map.height - 1);
}

/// blocked |= bits >> offset, words `first` to `last`.
void Occupancy::block(const Word* bits, int offset, size_t first, size_t last) {
    const size_t skip = static_cast<size_t>(offset) / 64;
    const int shift = offset & 63;
    if (skip + first >= words_) return;
    Word* target = blocked_.data();
    const Word* source = bits + skip;
    const size_t end = std::min(last + 1, words_ - skip);
    work_ += end - first;
    if (shift == 0) {
        for (size_t i = first; i < end; ++i) target[i] |= source[i];
        return;
    }
    const size_t whole = std::min(end, words_ - skip - 1);
    for (size_t i = first; i < whole; ++i) target[i] |= (source[i] >> shift) | (source[i + 1] << (64 - shift));
    if (whole < end) target[whole] |= source[whole] >> shift;
}

/// Leaves only the words from the first to the last with a free place; false when there is none.
bool Occupancy::narrow(size_t& first, size_t& last) const {
    while (first <= last && ~blocked_[first] == 0) ++first;
    if (first > last) return false;
    while (~blocked_[last] == 0) --last;
    return true;
}

int Occupancy::first_free(Template& mask, int y) {
    const int places = map_.width - mask.width + 1;
    const Mask::Square& square = mask.squares[0];
    if (places <= 0 || largest_[static_cast<size_t>(y + square.y)] < square.level) return -1;
    if (longest_[static_cast<size_t>(y + mask.longest.row)] < mask.longest.length) return -1;
    size_t first = 0;
    size_t last = static_cast<size_t>(places - 1) / 64;
    std::fill(blocked_.begin(), blocked_.begin() + static_cast<std::ptrdiff_t>(last + 1), 0);
    if (places % 64 != 0) blocked_[last] = ~Word{0} << (places % 64);
    for (const Mask::Square& b : mask.squares) block(squares_.data() + place(b.level, y + b.y), b.x, first, last);
    if (!narrow(first, last)) return -1;
    constexpr size_t look_every = 4;  // runs between two looks whether any place is left
    size_t next_look = look_every;
    for (size_t i = 0; i < mask.runs.size(); ++i) {
        const Template::Block b = mask.runs[i];
        block(runs_.data() + place(b.level, y + b.y), b.x, first, last);
        if (i + 1 < next_look) continue;
        if (!narrow(first, last)) {
            for (size_t k = i; k > i - std::min(i, look_every); --k) std::swap(mask.runs[k], mask.runs[k / 2]);
            return -1;
        }
        next_look = i + 1 + look_every;
    }
    if (!narrow(first, last)) return -1;
    return static_cast<int>(first * 64) + std::countr_one(blocked_[first]);
}

void Occupancy::take_run(int row, int begin, int end) {
    for (int x = begin; x < end;) {
        const int in_word = x & 63;
        const int count = std::min(64 - in_word, end - x);
        const Word ones = count == 64 ? ~Word{0} : ((Word{1} << count) - 1);
        const size_t at = place(0, row) + static_cast<size_t>(x >> 6);
        runs_[at] |= ones << in_word;
        squares_[at] |= ones << in_word;
        x += count;
    }
}

/// Bits of `level` from those of the level below: of the same row, or of it and the one `rise` above.
void Occupancy::refresh(std::vector<Word>& bits, int level, int rise, const Range& range) {
    const int half = 1 << (level - 1);
    const size_t skip = static_cast<size_t>(half) / 64;
    const int shift = half & 63;
    for (int row = range.low; row <= range.high; ++row) {
        const Word* a = bits.data() + place(level - 1, row);
        const Word* b = row + rise < map_.height ? bits.data() + place(level - 1, row + rise) : a;
        Word* target = bits.data() + place(level, row);
        for (size_t i = range.first_word; i <= range.last_word; ++i) {
            const Word low = i + skip < words_ ? a[i + skip] | b[i + skip] : 0;
            const Word high = i + skip + 1 < words_ ? a[i + skip + 1] | b[i + skip + 1] : 0;
            target[i] = a[i] | b[i] | (shift == 0 ? low : (low >> shift) | (high << (64 - shift)));
        }
    }
}

void Occupancy::refresh_largest(int low, int high) {
    const auto is_room = [&](int row, int level) {
        const int places = map_.width - (1 << level) + 1;
        if (places <= 0 || row + (1 << level) > map_.height) return false;
        const Word* bits = squares_.data() + place(level, row);
        for (int i = 0; i * 64 < places; ++i)
            if (~bits[i] != 0) return i * 64 + std::countr_one(bits[i]) < places;
        return false;
    };
    for (int row = low; row <= high; ++row) {
        int8_t& largest = largest_[static_cast<size_t>(row)];
        while (largest >= 0 && !is_room(row, largest)) --largest;
    }
}

void Occupancy::refresh_longest(int low, int high) {
    for (int row = low; row <= high; ++row) {
        const Word* bits = runs_.data() + place(0, row);
        int longest = 0;
        int free = 0;
        for (int x = 0; x < map_.width;) {
            const Word rest = bits[x >> 6] >> (x & 63);
            const int taken = std::countr_one(rest);
            if (taken > 0) {
                x += taken;
                free = 0;
                continue;
            }
            const int end = std::min(map_.width, std::min((x | 63) + 1, x + std::countr_zero(rest)));
            free += end - x;
            longest = std::max(longest, free);
            x = end;
        }
        longest_[static_cast<size_t>(row)] = longest;
    }
}

void Occupancy::take(const Mask& mask, int x, int y, int gutter) {
    for (const Mask::Run& run : mask.runs) {
        const int begin = std::max(0, x + run.begin - gutter);
        const int end = std::min(map_.width, x + run.begin + run.length + gutter);
        const int low = std::max(0, y + run.row - gutter);
        const int high = std::min(map_.height - 1, y + run.row + gutter);
        for (int row = low; row <= high; ++row) take_run(row, begin, end);
    }
    const int low = std::max(0, y - gutter);
    const int high = std::min(map_.height - 1, y + mask.height - 1 + gutter);
    const int left = std::max(0, x - gutter);
    const auto last = static_cast<size_t>(std::min(map_.width, x + mask.width + gutter) - 1) / 64;
    const auto first_word = [&](int level) { return static_cast<size_t>(std::max(0, left - (1 << level) + 1)) / 64; };
    for (int level = 1; level < run_levels; ++level) refresh(runs_, level, 0, {first_word(level), last, low, high});
    const auto lowest = [&](int level) { return std::max(0, low - (1 << level) + 1); };
    for (int level = 1; level < square_levels; ++level)
        refresh(squares_, level, 1 << (level - 1), {first_word(level), last, lowest(level), high});
    refresh_largest(lowest(square_levels - 1), high);
    refresh_longest(low, high);
}

}  // namespace surimi
