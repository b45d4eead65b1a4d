// SPDX-License-Identifier: Apache-2.0
// What a seam costs: how much of it is seen, and how many texels it is worth to be without it.
#pragma once

#include "baker/unwrap/half_edge.h"

namespace surimi {

struct SeamLength {
    double visible = 0;  ///< across edges that are no creases, metres
    double all = 0;      ///< metres
};

/// Adds the edge from corner k of a face, which has a face beyond.
void add_edge(const FaceGraph& graph, uint32_t face, uint32_t k, SeamLength& length);

/// The room on the map, in square metres, that it is worth to be without this seam in charts of such an area.
double worth_of(const SeamLength& seam, double area);

}  // namespace surimi
