// SPDX-License-Identifier: Apache-2.0
// Where an unwrap put more or fewer texels than usual, for people.
#pragma once

#include "baker/unwrap/atlas.h"

namespace surimi {

/// Prints a line to stderr for each cause that weighs charts of the atlas: how many, how large, which densities. The
/// manifest has them surface by surface.
void print_density_weights(const Atlas& atlas);

}  // namespace surimi
