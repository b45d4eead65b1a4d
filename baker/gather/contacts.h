// SPDX-License-Identifier: Apache-2.0
// Where other surfaces stand on a texel or come through it: visibility has a step there, and none between (M57).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "baker/texel/texel_surface.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// A texel is cut in so many pieces at most: each is a point at least. Texels of more are left to rays: the few that
/// most light comes to could go unseen.
inline constexpr size_t most_parts_of_texel = 24;

/// Relative to RayScene::center().
struct BoxedTriangle {
    std::array<Vec3, 3> corners;
    Vec3 low{0}, high{0};
};

/// The triangles whose boxes meet that of the places.
std::vector<BoxedTriangle> triangles_around(const RayScene& rays, std::span<const Vec3> places);

/// The segments in which the triangles cross the places that rays from the texel start from (M57), into `lines`, and
/// some that pass close by; and edges that lie above them by less than `slab`, metres. `triangles`: all that come near.
/// A texel of more pieces than it may be cut in has none.
void find_contacts(const RayScene& rays, std::span<const BoxedTriangle> triangles, const TexelSurface& surface,
                   double slab, std::vector<TexelSurface::Crossing>& lines);

/// Cuts the texel along contacts, as long as there are few enough parts; see TexelSurface::cut.
TexelSurface::CutResult cut_along(std::span<const TexelSurface::Crossing> contacts, TexelSurface& surface);

/// Both, without a slab.
TexelSurface::CutResult cut_at_contacts(const RayScene& rays, std::span<const BoxedTriangle> triangles,
                                        TexelSurface& surface);

}  // namespace surimi
