// SPDX-License-Identifier: Apache-2.0
// Where on a map something changes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace surimi {

/// Both take a map of `width` row by row and `rings` of eight neighbours, 1 to 255; linear in the texels, parallel.
/// 1 where one of another kind, or the map's end, is at most `rings` rings away, else 0.
std::vector<uint8_t> rim(std::span<const uint64_t> kinds, int width, int rings);
/// 1 where `mask` is not 0 at most `rings` rings away, else 0.
std::vector<uint8_t> spread(std::vector<uint8_t> mask, int width, int rings);

}  // namespace surimi
