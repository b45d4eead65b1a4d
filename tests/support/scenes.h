// SPDX-License-Identifier: Apache-2.0
// Small scenes and atlases, built in code.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi::test {

/// Adds a quad a, b, c, d (counter-clockwise seen from its front) as a node and surface of its own; returns the index.
uint32_t add_quad(Scene& scene, const std::string& name, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Adds an axis-aligned box as one surface with flat normals that point out, or in for a room.
uint32_t add_box(Scene& scene, const std::string& name, const Vec3& center, const Vec3& size, bool inwards = false);

/// Adds a rectangle that is monitor `channel`; half_u x half_v points to its front.
void add_monitor(Scene& scene, const std::string& name, int channel, const Vec3& center, const Vec3& half_u,
                 const Vec3& half_v);

/// The sample room of Kanikama 4.0, from its published numbers (research/kanikama.md 5.1): a cube of 6 m, four boxes,
/// two monitors.
Scene kanikama_room();

/// An atlas that shows one quad surface on the whole map, `size` x `size`, and every other surface nowhere.
Atlas whole_map_atlas(const Scene& scene, uint32_t quad, int size);

}  // namespace surimi::test
