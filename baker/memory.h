// SPDX-License-Identifier: Apache-2.0
// How much memory a bake will take, and how it keeps within a bound.
#pragma once

#include <functional>

#include "baker/bake.h"
#include "baker/preparation.h"

namespace surimi {

/// Bytes. All but those of Embree and the process follow from the scene.
struct PlannedMemory {
    size_t map = 0;          ///< maps and the evidence behind them
    size_t texels = 0;       ///< which triangles each touches
    size_t silhouettes = 0;  ///< edges, planes, tree
    size_t passing = 0;      ///< at most at a time beside all others: one band's light, or what is filled
    size_t embree = 0;       ///< measured
    size_t peak = 0;         ///< of the process: measured so far, and what is still to come
};

PlannedMemory planned_memory(const Scene& scene, const Preparation& preparation, const BakeSettings& settings);

/// GatherSettings::band_rows with which the bake keeps within settings.memory: those asked for where they do, else
/// the most that do. Without a bound those asked for. Throws Error(usage) where none do.
int rows_within_memory(const Scene& scene, const Preparation& preparation, const BakeSettings& settings);

/// The most of `rows`, half of them and so on down to one tile with which bytes_with(rows) is within the bound; 0:
/// none.
int most_rows_within(size_t bound, int rows, const std::function<size_t(int rows)>& bytes_with);

/// Throws Error(usage) where maps and evidence alone, of the size asked for, are more than settings.memory: to be known
/// before anything is done. Nothing is known of a map whose size follows from its density.
void check_memory_of_maps(const Scene& scene, const BakeSettings& settings);

}  // namespace surimi
