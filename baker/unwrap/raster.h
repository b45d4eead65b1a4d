// SPDX-License-Identifier: Apache-2.0
// A flat triangle -> the texels that it reaches, as runs of rows: time grows with rows and texels, not with boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "baker/unwrap/check.h"

namespace surimi {

/// Rows [first_row, end_row) of a map that is `width` texels wide.
struct TexelRows {
    int width = 0;
    int first_row = 0;
    int end_row = 0;
};

/// Least and greatest x of the triangle between two heights, which it has to reach.
inline std::pair<double, double> range_between(const FlatTriangle& t, double bottom, double top) {
    double from = INFINITY;
    double to = -INFINITY;
    for (size_t e = 0; e < 3; ++e) {
        const Vec2& a = t[e];
        const Vec2& b = t[(e + 1) % 3];
        const double low = std::max(std::min(a.y, b.y), bottom);
        const double high = std::min(std::max(a.y, b.y), top);
        if (low > high) continue;
        const double rise = b.y - a.y;
        const auto x_at = [&](double y) { return a.x + (b.x - a.x) * std::clamp((y - a.y) / rise, 0.0, 1.0); };
        const double x0 = rise == 0 ? a.x : x_at(low);
        const double x1 = rise == 0 ? b.x : x_at(high);
        from = std::min(from, std::min(x0, x1));
        to = std::max(to, std::max(x0, x1));
    }
    return {from, to};
}

/// Calls `visit(row, first, last)` for the texels whose open square of half side `reach` around the centre meets the
/// triangle: 0.5 for the texels that it touches, 1 for those that a bilinear read on it touches, 0 for those whose
/// centre it covers. Coordinates are texels, finite, in any winding.
template <class Visit>
void visit_runs(const FlatTriangle& t, double reach, const TexelRows& rows, const Visit& visit) {
    const auto first_after = [&](double low, int least) {  // centre above low - reach
        return std::max(least, static_cast<int>(std::floor(std::max(low - reach - 0.5, least - 1.0))) + 1);
    };
    const auto last_before = [&](double high, int most) {  // centre below high + reach
        return std::min(most, static_cast<int>(std::ceil(std::min(high + reach - 0.5, most + 1.0))) - 1);
    };
    const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
    const int last_row = last_before(high, rows.end_row - 1);
    for (int row = first_after(low, rows.first_row); row <= last_row; ++row) {
        const auto [from, to] = range_between(t, row + 0.5 - reach, row + 0.5 + reach);
        const int first = first_after(from, 0);
        const int last = last_before(to, rows.width - 1);
        if (first <= last) visit(row, first, last);
    }
}

}  // namespace surimi
