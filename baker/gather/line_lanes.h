// SPDX-License-Identifier: Apache-2.0
// The two loops of scanlines that run in SIMD: which lines a segment crosses, and the light up to an interval's end.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/gather/segments.h"

namespace surimi {

/// Lines y = bottom + (j + shift) * spacing, j = 0 ... count - 1, of the frame whose x axis is turned by an angle with
/// this cosine and sine against the panel's s axis.
struct Lattice {
    double cosine = 1, sine = 0;
    double bottom = 0, spacing = 1, shift = 0.5;
    int count = 0;

    double height(int line) const { return bottom + (line + shift) * spacing; }
    Vec2 to_panel(const Vec2& p) const { return {p.x * cosine - p.y * sine, p.x * sine + p.y * cosine}; }
    Vec2 to_frame(const Vec2& p) const { return {p.x * cosine + p.y * sine, p.y * cosine - p.x * sine}; }
};

/// Segments that cross lines at all: lines first ... last, at x + (line - first) * step.
struct LineSegments {
    std::vector<double> x, step, jump;  ///< jump: what is added when crossing towards larger x
    std::vector<double> first, last;    ///< whole numbers
    size_t count = 0;
};

/// A segment crosses the lines with lower end <= y < upper end, so that chains of segments cross every line once.
void find_crossed_lines(const Segments& segments, const Lattice& lattice, LineSegments& crossed);

/// Ends of intervals, and what the closed form of (M54) needs of their lines.
struct LineEnds {
    std::vector<double> tangent;  ///< of the angle from the foot of the point on the line
    std::vector<double> weight;   ///< factors of tangent / (1 + tangent^2) + arctan(tangent)
    std::vector<double> offset;   ///< and of -1 / (1 + tangent^2)
    std::vector<double> light;    ///< result
    size_t count = 0;

    void clear() { tangent.clear(), weight.clear(), offset.clear(); }
    void add(double t, double w, double o) { tangent.push_back(t), weight.push_back(w), offset.push_back(o); }
};

/// light = weight (t / (1 + t^2) + arctan t) - offset / (1 + t^2) for every end.
void integrate_to_ends(LineEnds& ends);

}  // namespace surimi
