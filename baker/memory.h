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
    size_t light = 0;        ///< a band of rows while it is lit, with what is there of its monitor, beyond `map`
    size_t post = 0;         ///< what is filled and stitched, beyond `map`
    size_t audit = 0;        ///< estimates and texels to draw from; 0 where none is asked for
    size_t passing = 0;      ///< at most at a time beside all others: the largest of the last three
    size_t writing = 0;      ///< what is written and read back, when the others but `map` are gone
    size_t embree = 0;       ///< measured
    size_t peak = 0;         ///< of the process up to its end: measured so far, and what is still to come
    int band_rows = 0;       ///< rows of a band
};

/// At settings.gather.band_rows.
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

/// From now on, whatever large piece of memory the process is done with goes back to the system at once, so that its
/// peak is what it holds. Where the C library does not offer it nothing changes.
void return_large_memory();

}  // namespace surimi
