// SPDX-License-Identifier: Apache-2.0
#include "baker/study/labels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace surimi {
namespace {

// In the order of preference; the unit of cost is a pixel of distance.
constexpr double cost_of_stroke = 60, cost_of_own_stroke = 40, cost_of_point = 150, cost_of_leader = 40;
constexpr double cost_of_overlap = 1e6;
constexpr std::array<double, 9> distances = {9, 18, 30, 45, 65, 90, 120, 160, 210};  // pixels from anchor to box
constexpr double leader_distance = 20;

/// Does the segment from a to b meet the box? Liang and Barsky 1984.
bool meets(const Box& box, const Vec2& a, const Vec2& b) {
    double first = 0, last = 1;
    for (int c = 0; c < 2; ++c) {
        const double d = b[c] - a[c];
        if (d == 0) {
            if (a[c] < box.low[c] || a[c] > box.high[c]) return false;
            continue;
        }
        const double t0 = (box.low[c] - a[c]) / d, t1 = (box.high[c] - a[c]) / d;
        first = std::max(first, std::min(t0, t1));
        last = std::min(last, std::max(t0, t1));
    }
    return first <= last;
}

double cost_of_crossing(const Box& box, const LabelledLine& line, double stroke) {
    double cost = 0;
    for (size_t i = 0; i < line.points.size(); ++i) {
        if (meets(box, line.points[i], line.points[i])) cost += cost_of_point;
        if (i > 0 && meets(box, line.points[i - 1], line.points[i])) cost += stroke;
    }
    return cost;
}

struct Candidate {
    PlacedLabel label;
    double cost = INFINITY;
};

Candidate judge(std::span<const LabelledLine> lines, size_t which, const PlacedLabel& label, const Box& area,
                std::span<const PlacedLabel> placed) {
    const Box& box = label.box;
    if (box.low.x < area.low.x || box.low.y < area.low.y || box.high.x > area.high.x || box.high.y > area.high.y)
        return {label, 2 * cost_of_overlap};
    double cost = label.needs_leader ? cost_of_leader : 0;
    for (const PlacedLabel& other : placed)
        if (overlap(box, other.box)) cost += cost_of_overlap;
    for (size_t i = 0; i < lines.size(); ++i)
        cost += cost_of_crossing(box, lines[i], i == which ? cost_of_own_stroke : cost_of_stroke);
    if (label.needs_leader)  // its stroke through other labels would mislead
        for (const PlacedLabel& other : placed)
            if (meets(other.box, label.anchor, 0.5 * (box.low + box.high))) cost += cost_of_point;
    return {label, cost};
}

/// The box of a given size whose nearest edge or corner is `distance` from the anchor in one of 16 directions.
PlacedLabel beside(const Vec2& anchor, const Vec2& size, int direction, double distance) {
    const double angle = direction * pi / 8;
    const Vec2 way(std::cos(angle), std::sin(angle));
    const Vec2 center = anchor + way * distance + 0.5 * size * way;
    return {{center - 0.5 * size, center + 0.5 * size}, anchor, distance > leader_distance};
}

PlacedLabel best_place(std::span<const LabelledLine> lines, size_t which, const Box& area,
                       std::span<const PlacedLabel> placed) {
    const LabelledLine& line = lines[which];
    Candidate best;
    for (size_t p = 0; p < line.points.size(); ++p) {
        for (const double distance : distances) {
            for (int direction = 0; direction < 16; ++direction) {
                const PlacedLabel label = beside(line.points[p], line.label_size, direction, distance);
                Candidate candidate = judge(lines, which, label, area, placed);
                // Ends of lines are where readers look for names.
                candidate.cost += distance + (p + 1 == line.points.size() || p == 0 ? 0 : 12);
                if (candidate.cost < best.cost) best = candidate;
            }
        }
    }
    return best.label;
}

}  // namespace

bool overlap(const Box& a, const Box& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

std::vector<PlacedLabel> place_labels(std::span<const LabelledLine> lines, const Box& area) {
    std::vector<PlacedLabel> placed;
    for (size_t i = 0; i < lines.size(); ++i) placed.push_back(best_place(lines, i, area, placed));
    return placed;
}

}  // namespace surimi
