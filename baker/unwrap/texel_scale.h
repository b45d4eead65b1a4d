// SPDX-License-Identifier: Apache-2.0
// The densities that the user wants for nodes and materials -> a factor for each surface.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi {

/// A wish of the configuration: surfaces of this node or its descendants, of this material, or, when both are given,
/// of this material on these nodes. Names may be shell globs (* and ?).
struct TexelScale {
    std::string node;
    std::string material;
    double scale = 1;  ///< texels a metre over the usual, from 0.001 to 1000
};

/// For each surface the product of extras.texel_scale of its material, its node and the node's ancestors, and of every
/// wish that holds for it (once, also where a pattern matches both a node and its parent); within [0.001, 1000].
/// Names are understood as --monitor understands them: literally if there is such a node, else as a glob, else as the
/// name of a surface. Throws Error(usage) for a wish that holds for no surface.
std::vector<double> texel_scales(const Scene& scene, const std::vector<TexelScale>& wishes);

}  // namespace surimi
