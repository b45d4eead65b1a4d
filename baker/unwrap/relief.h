// SPDX-License-Identifier: Apache-2.0
// Slits that let a patch lie flatter: cuts from its boundary to where the curvature gathers, which leave it in one piece.
#pragma once

#include <optional>

#include "baker/unwrap/distortion.h"
#include "baker/unwrap/flatten.h"
#include "baker/unwrap/patch.h"

namespace surimi {

/// The patch as one chart within the bound, when slits can bring it there that is nearly there without: each leads from
/// the boundary to where the surface is domed, along edges, on the way that shows least (creases are nearly free), and
/// stays when it lowers the energy and opens without overlap. `seams` gets the slits; when nothing is returned, it may
/// hold some of them. `number` as for build_patch.
std::optional<FlatChart> relieve(const FaceGraph& graph, const Patch& whole, const DistortionBound& bound,
                                 std::vector<uint32_t>& number, Seams& seams);

}  // namespace surimi
