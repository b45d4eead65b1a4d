// SPDX-License-Identifier: Apache-2.0
// Where the names of a plot's lines go: beside their line, on nothing else.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

/// Places in pixels, y down.
struct Box {
    Vec2 low{0}, high{0};
};

bool overlap(const Box& a, const Box& b);

struct LabelledLine {
    std::vector<Vec2> points;
    Vec2 label_size{0};
};

struct PlacedLabel {
    Box box;
    Vec2 anchor{0};             ///< the point of its line that it stands beside
    bool needs_leader = false;  ///< too far from it to belong to it without a stroke
};

/// A place for every line's label (a line has at least one point) within `area`, none on another while there is room.
/// Of all places around all points of its line, near ones first, the one that covers fewest points and strokes of any
/// line. The first choose first. Deterministic; the cost is that of lines^2 * points^2.
std::vector<PlacedLabel> place_labels(std::span<const LabelledLine> lines, const Box& area);

}  // namespace surimi
