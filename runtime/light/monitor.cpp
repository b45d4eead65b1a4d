// SPDX-License-Identifier: Apache-2.0
#include "runtime/light/monitor.h"

namespace surimi {
namespace {

/// Twice the area times the normal. Seen from the first corner, so that far from the origin no digits are
/// lost.
Vec3 newell_sum(const Polygon& polygon) {
    Vec3 sum(0);
    for (size_t i = 1; i + 1 < polygon.corners.size(); ++i)
        sum += area_normal(polygon.corners[0], polygon.corners[i], polygon.corners[i + 1]);
    return sum;
}

}  // namespace

Vec3 front_normal(const Polygon& polygon) {
    return normalize_or(newell_sum(polygon), Vec3(0, 0, 1));
}

double area(const Polygon& polygon) {
    return 0.5 * glm::length(newell_sum(polygon));
}

double area(const Monitor& monitor) {
    double sum = 0;
    for (const Polygon& panel : monitor.panels) sum += area(panel);
    return sum;
}

}  // namespace surimi
