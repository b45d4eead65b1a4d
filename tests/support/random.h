// SPDX-License-Identifier: Apache-2.0
// A small sequential generator for tests. The product's random numbers are keyed by item instead.
#pragma once

#include "runtime/base/math.h"
#include "runtime/base/random.h"

namespace surimi {

struct Random {
    uint64_t key = 0;
    uint64_t counter = 0;
    constexpr double next() { return unit_double(hash(key, counter++)); }
};

/// Random numbers and vectors by what they are for.
struct Choice {
    Random random;
    double between(double low, double high) { return low + (high - low) * random.next(); }
    /// Evenly in the cube from -1 to 1.
    Vec3 vector() {
        const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
        return {x, y, z};
    }
    Vec3 direction() { return normalize_or(vector(), {0, 0, 1}); }
};

}  // namespace surimi
