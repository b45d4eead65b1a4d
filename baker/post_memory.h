// SPDX-License-Identifier: Apache-2.0
// How much memory the stages after light take, beside the maps and what is known of their texels.
#pragma once

#include "baker/preparation.h"

namespace surimi {

/// Bytes of a list of `count` items that grew by doubling.
size_t grown_bytes(size_t count, size_t of_item);

/// Bytes that fill(), grow_gutters(), fit_bilinear() and stitch() hold at most beside all pages' channels, for this
/// monitor. Which texels it lights is foretold by their triangles' corners. Linear in the texels.
size_t post_bytes(const Scene& scene, const Preparation& preparation, size_t monitor, const PostSettings& settings);

/// Bytes that audit() holds for a page, with its estimates.
size_t audit_bytes(const Texels& texels);

}  // namespace surimi
