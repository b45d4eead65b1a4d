// SPDX-License-Identifier: Apache-2.0
// Slits that let a patch lie flatter: cuts from its boundary to where the curvature gathers, which leave it in one piece.
#pragma once

#include "baker/unwrap/distortion.h"
#include "baker/unwrap/patch.h"

namespace surimi {

/// Cuts the slit that saves the most predicted energy for its visible length, along edges, creases nearly for free.
/// `logarithms` are those of the patch. False when no place is curved enough to be worth one; then nothing is cut.
bool cut_relief(const FaceGraph& graph, const Patch& patch, const std::vector<double>& logarithms, Seams& seams);

}  // namespace surimi
