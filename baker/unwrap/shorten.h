// SPDX-License-Identifier: Apache-2.0
// Charts too long or too hollow for the map -> shorter ones, as they lie.
#pragma once

#include <vector>

#include "baker/unwrap/flatten.h"

namespace surimi {

/// A chart longer than the map is wide would set the density of all others, and a ring or an arc keeps the map around
/// it empty. Such charts are divided where that shows least, as long as the room that it saves is worth the seam.
/// `graphs` are those of the surfaces; `factors` the density of each chart over the atlas' density; `aspect` is the
/// map's longer side over its shorter one.
void shorten_charts(const std::vector<FaceGraph>& graphs, const std::vector<double>& factors, double aspect,
                    std::vector<FlatChart>& charts);

}  // namespace surimi
