// SPDX-License-Identifier: Apache-2.0
// A small sequential generator for tests. The product's random numbers are keyed by item instead.
#pragma once

#include "runtime/base/random.h"

namespace surimi {

struct Random {
    uint64_t key = 0;
    uint64_t counter = 0;
    constexpr double next() { return unit_double(hash(key, counter++)); }
};

}  // namespace surimi
