// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/artefact_scene.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

namespace surimi::test {

bool is_enclosed(const ArtefactScene& stage, uint32_t surface, const Vec3& position) {
    constexpr double rounding = 1e-9;  // of places of some metres
    return std::any_of(stage.solids.begin(), stage.solids.end(), [&](const Solid& solid) {
        return solid.surface != surface && glm::all(glm::greaterThanEqual(position, solid.low - rounding)) &&
               glm::all(glm::lessThanEqual(position, solid.high + rounding));
    });
}

Solid solid_of(const Scene& scene, uint32_t surface) {
    Solid solid{surface, Vec3(INFINITY), Vec3(-INFINITY)};
    for (const Vec3& p : scene.surfaces[surface].positions) {
        solid.low = glm::min(solid.low, p);
        solid.high = glm::max(solid.high, p);
    }
    return solid;
}

Scene moved(Scene scene, const Vec3& axis, double angle, double factor, const Vec3& offset) {
    const Mat3 turn(glm::rotate(Mat4(1), angle, axis));
    for (Surface& surface : scene.surfaces) {
        for (Vec3& p : surface.positions) p = factor * (turn * p) + offset;
        for (Vec3& n : surface.normals) n = turn * n;
    }
    for (Monitor& monitor : scene.monitors)
        for (Polygon& panel : monitor.panels)
            for (Vec3& p : panel.corners) p = factor * (turn * p) + offset;
    return scene;
}

}  // namespace surimi::test
