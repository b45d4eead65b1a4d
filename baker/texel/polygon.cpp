// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/polygon.h"

namespace surimi {

void cut(std::span<const Vec2> polygon, const Vec3& line, std::vector<Vec2>& part) {
    part.clear();
    const auto side = [&](const Vec2& p) { return p.x * line.x + p.y * line.y + line.z; };
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        const double da = side(a), db = side(b);
        if (da >= 0) part.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) part.push_back(a + (b - a) * (da / (da - db)));
    }
    if (part.size() < 3) part.clear();
}

double area_of(std::span<const Vec2> polygon) {
    double doubled = 0;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Vec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
        doubled += a.x * b.y - a.y * b.x;
    }
    return 0.5 * doubled;
}

}  // namespace surimi
