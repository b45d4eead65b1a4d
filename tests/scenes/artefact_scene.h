// SPDX-License-Identifier: Apache-2.0
// A tiny scene that provokes one artefact, with what its test has to know.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi::test {

/// An axis-aligned box that is full: what lies in it, its boundary included, is seen by nobody.
struct Solid {
    uint32_t surface = 0;  ///< that bounds it and is not within it
    Vec3 low{0}, high{0};
};

struct ArtefactScene {
    Scene scene;
    std::vector<uint32_t> surfaces;  ///< whose maps are judged
    std::vector<Solid> solids;
    std::optional<Scene> equal;  ///< with the same shadows and the same judged surfaces, but without alpha masks
};

/// Does the point of `surface` lie in or against one of the solids?
bool is_enclosed(const ArtefactScene& stage, uint32_t surface, const Vec3& position);

/// The solid of an axis-aligned box that is one surface of the scene.
Solid solid_of(const Scene& scene, uint32_t surface);

/// Turns the scene by `angle` radians about `axis`, then scales it by `factor`, then moves it by `offset`.
Scene moved(Scene scene, const Vec3& axis, double angle, double factor, const Vec3& offset);

}  // namespace surimi::test
