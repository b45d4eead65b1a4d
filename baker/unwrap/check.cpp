// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/check.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

struct Box {
    Vec2 low{INFINITY};
    Vec2 high{-INFINITY};
};

Box box_of(const FlatTriangle& t) {
    return {glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))};
}

/// Whether all of `other` lies outside one edge of `t`, or at most `margin` inside.
bool is_separated_by_an_edge(const FlatTriangle& t, const FlatTriangle& other, double margin) {
    for (size_t e = 0; e < 3; ++e) {
        const Vec2& a = t[e];
        const Vec2& b = t[(e + 1) % 3];
        const double limit = margin > 0 ? margin * glm::length(b - a) : 0;
        const bool is_outside = doubled_area(a, b, other[0]) <= limit && doubled_area(a, b, other[1]) <= limit &&
                                doubled_area(a, b, other[2]) <= limit;
        if (is_outside) return true;
    }
    return false;
}

/// Square cells over all triangles; each lists the triangles that reach into it.
class Grid {
  public:
    explicit Grid(const std::vector<FlatTriangle>& triangles) {
        Box all;
        for (const FlatTriangle& t : triangles) {
            const Box b = box_of(t);
            all.low = glm::min(all.low, b.low);
            all.high = glm::max(all.high, b.high);
        }
        low_ = all.low;
        const Vec2 size = all.high - all.low;
        const double most = 2048;  // rows or columns: 4 million cells
        const double cells = std::clamp(static_cast<double>(triangles.size()), 1.0, most * most);
        cell_ = std::max(std::sqrt(size.x * size.y / cells), std::max(size.x, size.y) / most);
        if (!(cell_ > 0)) cell_ = 1;
        columns_ = static_cast<int>(size.x / cell_) + 1;
        rows_ = static_cast<int>(size.y / cell_) + 1;
        begin_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
        for (const FlatTriangle& t : triangles) each_cell(t, [&](size_t c) { ++begin_[c + 1]; });
        for (size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
        items_.resize(begin_.back());
        std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (uint32_t i = 0; i < triangles.size(); ++i)
            each_cell(triangles[i], [&](size_t c) { items_[next[c]++] = i; });
    }

    size_t cell_count() const { return begin_.size() - 1; }
    const uint32_t* begin(size_t cell) const { return items_.data() + begin_[cell]; }
    const uint32_t* end(size_t cell) const { return items_.data() + begin_[cell + 1]; }

  private:
    int column(double x) const { return std::clamp(static_cast<int>((x - low_.x) / cell_), 0, columns_ - 1); }
    int row(double y) const { return std::clamp(static_cast<int>((y - low_.y) / cell_), 0, rows_ - 1); }

    /// Cells that the triangle reaches, row by row, so that a long needle does not fill the box around it.
    template <class Visit>
    void each_cell(const FlatTriangle& t, const Visit& visit) const {
        const Box box = box_of(t);
        const double slack = 1e-9 * cell_;
        for (int r = row(box.low.y); r <= row(box.high.y); ++r) {
            const double bottom = low_.y + r * cell_ - slack;
            const double top = low_.y + (r + 1) * cell_ + slack;
            double from = INFINITY;
            double to = -INFINITY;
            for (size_t e = 0; e < 3; ++e) clip_to_band(t[e], t[(e + 1) % 3], {bottom, top}, from, to);
            if (!(from <= to)) continue;
            for (int c = column(from - slack); c <= column(to + slack); ++c)
                visit(static_cast<size_t>(r) * static_cast<size_t>(columns_) + static_cast<size_t>(c));
        }
    }

    /// Widens [from, to] by the x range of the edge a b between two heights.
    static void clip_to_band(const Vec2& a, const Vec2& b, const Vec2& band, double& from, double& to) {
        const double low = std::max(std::min(a.y, b.y), band.x);
        const double high = std::min(std::max(a.y, b.y), band.y);
        if (low > high) return;
        const double rise = b.y - a.y;
        for (const double y : {low, high}) {
            const double x = rise == 0 ? a.x : a.x + (b.x - a.x) * std::clamp((y - a.y) / rise, 0.0, 1.0);
            from = std::min(from, rise == 0 ? std::min(a.x, b.x) : x);
            to = std::max(to, rise == 0 ? std::max(a.x, b.x) : x);
        }
    }

    Vec2 low_{0};
    double cell_ = 1;
    int columns_ = 1;
    int rows_ = 1;
    std::vector<uint32_t> begin_;
    std::vector<uint32_t> items_;
};

}  // namespace

double longest_edge_squared(const FlatTriangle& t) {
    const Vec2 a = t[1] - t[0];
    const Vec2 b = t[2] - t[1];
    const Vec2 c = t[0] - t[2];
    return std::max(glm::dot(a, a), std::max(glm::dot(b, b), glm::dot(c, c)));
}

bool do_overlap(const FlatTriangle& a, const FlatTriangle& b, double margin) {
    return !is_separated_by_an_edge(a, b, margin) && !is_separated_by_an_edge(b, a, margin);
}

double overlap_area(FlatTriangle a, FlatTriangle b) {
    if (doubled_area(a) < 0) std::swap(a[1], a[2]);
    if (doubled_area(b) < 0) std::swap(b[1], b[2]);
    std::vector<Vec2> rest(a.begin(), a.end());
    for (size_t e = 0; e < 3 && !rest.empty(); ++e) {  // cut `rest` by the half-plane of each edge of b
        std::vector<Vec2> kept;
        for (size_t i = 0; i < rest.size(); ++i) {
            const Vec2& p = rest[i];
            const Vec2& q = rest[(i + 1) % rest.size()];
            const double inside_p = doubled_area(b[e], b[(e + 1) % 3], p);
            const double inside_q = doubled_area(b[e], b[(e + 1) % 3], q);
            if (inside_p >= 0) kept.push_back(p);
            if ((inside_p > 0 && inside_q < 0) || (inside_p < 0 && inside_q > 0))
                kept.push_back(p + (q - p) * (inside_p / (inside_p - inside_q)));
        }
        rest = std::move(kept);
    }
    double sum = 0;
    for (size_t i = 1; i + 1 < rest.size(); ++i) sum += doubled_area(rest[0], rest[i], rest[i + 1]);
    return 0.5 * sum;
}

void visit_close_pairs(const std::vector<FlatTriangle>& triangles,
                       const std::function<bool(uint32_t, uint32_t)>& visit) {
    if (triangles.size() < 2) return;
    std::vector<Box> boxes;
    boxes.reserve(triangles.size());
    for (const FlatTriangle& t : triangles) boxes.push_back(box_of(t));
    const Grid grid(triangles);
    for (size_t cell = 0; cell < grid.cell_count(); ++cell) {
        for (const uint32_t* i = grid.begin(cell); i != grid.end(cell); ++i) {
            for (const uint32_t* j = i + 1; j != grid.end(cell); ++j) {
                const Box& a = boxes[*i];
                const Box& b = boxes[*j];
                const bool are_apart =
                    a.high.x <= b.low.x || b.high.x <= a.low.x || a.high.y <= b.low.y || b.high.y <= a.low.y;
                if (!are_apart && !visit(*i, *j)) return;
            }
        }
    }
}

std::vector<std::array<uint32_t, 2>> overlapping_pairs(const std::vector<FlatTriangle>& triangles, double margin,
                                                       size_t limit) {
    std::vector<FlatTriangle> upright;
    std::vector<uint32_t> number;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        if (!(doubled_area(triangles[i]) > 0)) continue;
        upright.push_back(triangles[i]);
        number.push_back(i);
    }
    std::vector<std::array<uint32_t, 2>> pairs;
    visit_close_pairs(upright, [&](uint32_t i, uint32_t j) {
        if (do_overlap(upright[i], upright[j], margin)) pairs.push_back({number[i], number[j]});
        return pairs.size() < limit;
    });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace surimi
