// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/mask.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace surimi {
namespace {

int texel_of(double x, int count) {
    return std::clamp(static_cast<int>(std::floor(x)), 0, count - 1);
}

}  // namespace

Mask flipped(const Mask& mask, bool in_x, bool in_y) {
    Mask result = mask;
    for (Mask::Run& run : result.runs) {
        if (in_x) run.begin = mask.width - run.begin - run.length;
        if (in_y) run.row = mask.height - 1 - run.row;
    }
    for (Mask::Square& square : result.squares) {
        if (in_x) square.x = mask.width - square.x - (1 << square.level);
        if (in_y) square.y = mask.height - square.y - (1 << square.level);
    }
    // The list is sorted by row, then by x.
    if (in_y) std::reverse(result.runs.begin(), result.runs.end());
    if (in_x == in_y) return result;
    for (auto begin = result.runs.begin(); begin != result.runs.end();) {
        const auto is_beyond = [&](const Mask::Run& run) { return run.row != begin->row; };
        const auto end = std::find_if(begin, result.runs.end(), is_beyond);
        std::reverse(begin, end);
        begin = end;
    }
    return result;
}

Raster::Raster(int width, int height)
    : width_(width),
      height_(height),
      words_(static_cast<size_t>(width + 63) / 64),
      bits_(words_ * static_cast<size_t>(height), 0),
      crossings_(bits_.size(), 0) {}

void Raster::touch_run(int y, int begin, int end) {
    for (int x = begin; x < end;) {
        const int in_word = x & 63;
        const int count = std::min(64 - in_word, end - x);
        const Word ones = count == 64 ? ~Word{0} : ((Word{1} << count) - 1);
        bits_[row(y) + static_cast<size_t>(x >> 6)] |= ones << in_word;
        x += count;
    }
}

void Raster::add_edge(const Vec2& a, const Vec2& b, double slack) {
    const Vec2& low = a.y < b.y ? a : b;
    const Vec2& high = a.y < b.y ? b : a;
    const double rise = high.y - low.y;
    const double slope = rise > 0 ? (high.x - low.x) / rise : 0;
    const auto x_at = [&](double y) { return low.x + (y - low.y) * slope; };
    const int y0 = texel_of(low.y - slack, height_);
    const int y1 = texel_of(high.y + slack, height_);
    for (int y = y0; y <= y1; ++y) {
        // The part of the edge between y and y + 1, both moved outwards by the slack.
        const double from = low.y >= y - slack ? low.x : x_at(y - slack);
        const double to = high.y <= y + 1 + slack ? high.x : x_at(y + 1 + slack);
        touch_run(y, texel_of(std::min(from, to) - slack, width_), texel_of(std::max(from, to) + slack, width_) + 1);
        const double centre = y + 0.5;
        if (!(low.y < centre && high.y >= centre)) continue;
        const double next = std::ceil(x_at(centre) - 0.5);  // the first texel with its centre to the right
        if (next >= width_) continue;
        const auto x = static_cast<size_t>(std::max(0.0, next));
        crossings_[row(y) + x / 64] ^= Word{1} << (x & 63);
    }
}

void Raster::fill() {
    for (int y = 0; y < height_; ++y) {
        Word carry = 0;
        for (size_t i = 0; i < words_; ++i) {
            Word inside = crossings_[row(y) + i];
            for (int shift = 1; shift < 64; shift *= 2) inside ^= inside << shift;  // parity of all bits up to each
            inside ^= carry;
            carry = (inside >> 63) != 0 ? ~Word{0} : 0;
            bits_[row(y) + i] |= inside;
        }
        if (width_ % 64 != 0) bits_[row(y) + words_ - 1] &= (Word{1} << (width_ % 64)) - 1;
    }
}

Raster Raster::cells(int cell) const {
    Raster result(width_ / cell, height_ / cell);
    for (const Mask::Run& run : mask().runs)
        result.touch_run(run.row / cell, run.begin / cell, (run.begin + run.length - 1) / cell + 1);
    return result;
}

Mask Raster::mask() const {
    Mask mask;
    mask.width = width_;
    mask.height = height_;
    for (int y = 0; y < height_; ++y) {
        int begin = -1;  // of the run that goes on, if one does
        for (size_t i = 0; i < words_; ++i) {
            const Word bits = bits_[row(y) + i];
            for (int x = 0; x < 64;) {
                const Word rest = begin < 0 ? bits >> x : ~bits >> x;
                if (rest == 0) break;
                x += std::countr_zero(rest);
                const int at = static_cast<int>(i * 64) + x;
                if (begin >= 0) mask.runs.push_back({y, begin, at - begin});
                begin = begin < 0 ? at : -1;
            }
        }
        if (begin >= 0) mask.runs.push_back({y, begin, width_ - begin});
    }
    for (const Mask::Run& run : mask.runs) mask.texels += static_cast<size_t>(run.length);
    add_squares(mask);
    return mask;
}

/// Low corners of touched squares twice as wide as those whose low corners these are, of side `half`.
Raster Raster::squares(int half) const {
    Raster result(width_, height_);
    const auto skip = static_cast<size_t>(half) / 64;
    const int shift = half & 63;
    for (int y = 0; y + half < height_; ++y) {
        const Word* a = bits_.data() + row(y);
        const Word* b = bits_.data() + row(y + half);
        Word* target = result.bits_.data() + row(y);
        for (size_t i = 0; i + skip < words_; ++i) {
            const Word low = (a[i + skip] & b[i + skip]) >> shift;
            const bool has_next = shift > 0 && i + skip + 1 < words_;
            const Word high = has_next ? (a[i + skip + 1] & b[i + skip + 1]) << (64 - shift) : 0;
            target[i] = a[i] & b[i] & (low | high);
        }
    }
    return result;
}

void Raster::add_squares(Mask& mask) const {
    const auto is_set = [](Word word) { return word != 0; };
    Raster corners = *this;
    int level = 0;
    for (; level < Mask::most_level; ++level) {
        Raster larger = corners.squares(1 << level);
        if (std::none_of(larger.bits_.begin(), larger.bits_.end(), is_set)) break;
        corners = std::move(larger);
    }
    const auto add = [&](size_t word, int bit) {
        const auto x = static_cast<int>(word % words_) * 64 + bit;
        mask.squares.push_back({x, static_cast<int>(word / words_), level});
    };
    const auto first = std::find_if(corners.bits_.begin(), corners.bits_.end(), is_set);
    if (first == corners.bits_.end()) return;
    const auto last = std::find_if(corners.bits_.rbegin(), corners.bits_.rend(), is_set);
    add(static_cast<size_t>(first - corners.bits_.begin()), std::countr_zero(*first));
    add(static_cast<size_t>(corners.bits_.rend() - last) - 1, 63 - std::countl_zero(*last));
}

}  // namespace surimi
