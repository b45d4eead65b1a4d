// SPDX-License-Identifier: Apache-2.0
// Masks of touched texels -> places on a map of a given size.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/unwrap/occupancy.h"

namespace surimi {

struct Placement {
    int x = 0;
    int y = 0;
    int turns = 0;  ///< of the mask: see turned()
    int mask = 0;   ///< index into the chart's masks
};

/// What "largest first" means. No order wins on all scenes: thin strips want the longer side, hollow frames
/// the box.
enum class PackOrder { longer_side, half_perimeter, box, texels };

/// What each chart makes as low as it goes.
enum class PackRule { upper_end, centre };

/// Charts ready to be packed, as often as one likes.
struct PackCharts {
    std::vector<std::vector<Mask>> masks;  ///< of each chart: its poses
    std::vector<std::vector<Template>> templates;
};

PackCharts prepare_charts(std::vector<std::vector<Mask>> masks);

/// How a chart lies: Mask::shape and Mask::turns.
struct Pose {
    int shape = 0;
    int turns = 0;
};

/// One way to pack.
struct PackPlan {
    PackOrder order = PackOrder::longer_side;
    PackRule rule = PackRule::upper_end;
    std::vector<double> boosts = {};  ///< factors of the charts' sizes in the order; empty: all 1
    std::vector<Pose> poses = {};     ///< that each chart has to take, if it has a mask of it; empty: any
};

struct Packing {
    std::vector<Placement> placements;  ///< for each chart
    std::vector<uint32_t> failed;       ///< charts that found no place
    uint64_t work = 0;                  ///< Occupancy::work
};

/// Places charts so that at least `gutter` untouched texels separate the touched texels of two of them: largest first,
/// each as low as it goes. Goes on after a chart that found no place until `most_failures` of them have. Deterministic.
Packing pack(const PackCharts& charts, const MapSize& map, int gutter, const PackPlan& plan, size_t most_failures = 1);

/// A lower bound of the texels that charts and gutters need; a map with fewer than (width + gutter) * (height
/// + gutter) cannot hold them.
double least_texels(const std::vector<std::vector<Mask>>& charts, int gutter);

}  // namespace surimi
