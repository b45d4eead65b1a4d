// SPDX-License-Identifier: Apache-2.0
// Flat charts of the shapes that unwrapping makes, for tests and measurements of packing.
#pragma once

#include <string>
#include <vector>

#include "baker/unwrap/flatten.h"

namespace surimi::test {

/// A strip of triangles between two lines of as many points (at least 2), `left` on the left of its course. Turned by
/// `angle` (radians) where it lies, not into its box of least area.
FlatChart strip_between(const std::vector<Vec2>& left, const std::vector<Vec2>& right, double angle = 0);

FlatChart rectangle_chart(double width, double height, double angle = 0);
/// Part of a ring: radii in metres, angle of the sector in radians.
FlatChart arc_chart(double inner, double outer, double sector);

struct ChartSet {
    std::string name;
    std::vector<FlatChart> charts;
};

/// Arcs, crescents, lunes of spheres, L and U shapes, blobs, long strips, rectangles and a mixture of all; the same on
/// every machine.
std::vector<ChartSet> chart_sets();

}  // namespace surimi::test
