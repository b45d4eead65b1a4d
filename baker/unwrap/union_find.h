// SPDX-License-Identifier: Apache-2.0
// Sets that grow together: each item points to another of its set, the last one to itself.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace surimi {

/// The item that stands for the set of `i`; shortens the way there.
inline uint32_t find_root(std::vector<uint32_t>& parent, uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/// Makes the sets of `a` and `b` one, which its lower root stands for.
inline void unite(std::vector<uint32_t>& parent, uint32_t a, uint32_t b) {
    a = find_root(parent, a);
    b = find_root(parent, b);
    parent[std::max(a, b)] = std::min(a, b);
}

}  // namespace surimi
