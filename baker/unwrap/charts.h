// SPDX-License-Identifier: Apache-2.0
// Faces -> charts that can be laid flat.
#pragma once

#include <vector>

#include "baker/unwrap/flatten.h"
#include "baker/unwrap/half_edge.h"

namespace surimi {

/// Cuts a surface into charts: every face in exactly one, no face seen from behind, no stretch beyond 1.6, no
/// overlap (up to the rounding that the map's size brings, which is judged later). Near-linear in the number
/// of faces.
std::vector<FlatChart> cut_into_charts(const FaceGraph& graph);

/// The same verdict for faces that were one chart before and are not to be grown again.
void add_valid_charts(const FaceGraph& graph, std::vector<uint32_t> faces, std::vector<FlatChart>& charts);

}  // namespace surimi
