// SPDX-License-Identifier: Apache-2.0
// Polygon lights on points with lobes, hazard by hazard, with exact shares in long double.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/batch/batch.h"

namespace surimi::test {

/// One light, emitting from both sides, and points that see it.
struct ShadingCase {
    std::vector<Vec3> corners;
    PointBatch points;
    std::vector<double> diffuse, specular;  ///< exact shares of the points
};

struct ShadingFamily {
    std::string name;
    std::vector<ShadingCase> cases;
};

/// The hazards H1 to H9 and H13 (inputs as in tests/stability/ltc_hazards_test.cpp, with random views and roughnesses),
/// and random rooms. `lights` of each kind, `points` for each of them. The same every time.
std::vector<ShadingFamily> shading_families(int lights, int points);

/// Irradiance / pi of both sides of a polygon: clipped to a list of corners in long double.
double exact_diffuse(std::span<const Vec3> corners, const Vec3& point, const Vec3& normal);

/// Share of ltc_lobe's lobe that both sides of a polygon fill: corners clipped to a list at the true horizon,
/// transformed and clipped again, in long double.
double exact_specular(std::span<const Vec3> corners, const Vec3& point, const Vec3& normal, const Vec3& view,
                      double roughness);

}  // namespace surimi::test
