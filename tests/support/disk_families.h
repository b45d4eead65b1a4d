// SPDX-License-Identifier: Apache-2.0
// Ellipses that break published disk lights, with their exact form factors: what tests and measurements share.
#pragma once

#include <string>
#include <vector>

#include "runtime/ltc/ellipse.h"
#include "tests/support/quadrature.h"
#include "tests/support/random.h"

namespace surimi::test {

/// An ellipse in the cosine's space: relative to the point, whose normal is z. All numbers are floats, so that methods
/// in float and in double have the same input.
struct DiskCase {
    Ellipse<double> ellipse;
    double exact;   ///< form factor of both sides
    bool is_above;  ///< does not touch the horizon
};

struct DiskFamily {
    std::string name;
    std::vector<DiskCase> cases;
};

/// The hazards H19 to H23 and random disks across the horizon, `count` of each; always the same ones.
std::vector<DiskFamily> disk_families(int count);

}  // namespace surimi::test
