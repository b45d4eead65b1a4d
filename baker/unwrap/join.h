// SPDX-License-Identifier: Apache-2.0
// Charts -> fewer charts: neighbours become one where that saves visible seam.
#pragma once

#include <vector>

#include "baker/unwrap/charts.h"

namespace surimi {

/// Joins charts along runs of seam, the longest visible ones first, while the result stays within the bound and free
/// of overlap. The number of tries is bounded by the triangles that they flatten, as settings.quality says.
void join_charts(const FaceGraph& graph, const CutSettings& settings, const Progress& progress, SeamFlags& seams,
                 std::vector<FlatChart>& charts);

}  // namespace surimi
