// SPDX-License-Identifier: Apache-2.0
// What a camera ray sees.
#pragma once

#include "runtime/preview/render.h"

namespace surimi {

/// A surface that a ray sees, wholly or through panes, and that is still to be shaded.
struct SeenPoint {
    ShadingPoint point;
    double weight = 1;  ///< share of the ray
    size_t pixel = 0;   ///< as the caller numbers them
};

struct Seen {
    Vec3 color{0};               ///< what needs no shading: emission, or what `show` asks for
    bool is_surface = false;     ///< something that does not emit took most of the ray
    double distance = INFINITY;  ///< metres to the first thing seen
    double roughness = -1;       ///< of what took most of the ray; -1: nothing that reflects
};

/// Follows a camera ray through blended surfaces and unseen back faces; surfaces that it sees are appended to `points`
/// where `show` is a lit view. `direction` need not be unit.
Seen see(const Lighting& lighting, const Vec3& eye, const Vec3& direction, Show show, uint64_t key, size_t pixel,
         std::vector<SeenPoint>& points);

/// Is it a view of reflected light, which needs shading?
inline bool is_lit_view(Show show) {
    return show == Show::lit || show == Show::diffuse || show == Show::specular;
}

/// The colour of a surface point in one of the other views.
Vec3 view_color(const Lighting& lighting, const ShadingPoint& point, Show show);

}  // namespace surimi
