// SPDX-License-Identifier: Apache-2.0
// Equal things found by sorting: vertices at one place, half-edges between the same two vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace surimi {

struct Keyed {
    uint64_t key = 0;    ///< evenly spread over all values: see mixed()
    uint32_t index = 0;  ///< of what has this key
};

/// One to one, and so that any bits of the result are as good as random (the finaliser of SplitMix64, public domain).
uint64_t mixed(uint64_t value);

/// By key, then index. Parallel.
void sort_by_key(std::vector<Keyed>& items);

/// For each place the smallest index of those that equal it (-0 and +0 do) and have the same owner. Parallel.
std::vector<uint32_t> weld(std::span<const Vec3f> places, std::span<const uint8_t> owners);

}  // namespace surimi
