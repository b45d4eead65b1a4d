// SPDX-License-Identifier: Apache-2.0
// Which texels, and which parts of them, lie inside other geometry: they get no light, and nobody sees them (M65).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "baker/gather/panel.h"
#include "baker/texel/texel_surface.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

struct ExposureCounts {
    size_t touched = 0;  ///< texels that other surfaces touch or cross
    size_t crossed = 0;  ///< of them: cut in parts by those
    size_t partly = 0;   ///< texels of which a part is inside
    size_t inside = 0;   ///< texels that are inside as a whole
    size_t turning = 0;  ///< texels that may be lit from the back
    size_t probes = 0;   ///< places judged
    std::vector<std::string> warnings;
};

/// Writes Texel::free_pieces and Texel::may_turn of all pages. Where nothing touches any texel there is nothing to
/// probe, and all stays free. Texels that no surface touches are judged in groups that hang together: one place in a
/// group of a tile says it for all. Two-sided surfaces' texels may turn where their back is not enclosed.
ExposureCounts find_exposures(const Scene& scene, const Atlas& atlas, const RayScene& rays, std::span<Texels> pages);

/// Judges the subtexels anew whose texel was found to be partly inside, and no others. `factor`: of the subdivision;
/// what counts as close by is a matter of texels.
void expose_parts(const Scene& scene, const Atlas& fine, const RayScene& rays, Texels& subtexels, int factor);

/// One page and what stands around it.
struct Receivers {
    const Scene& scene;
    const Atlas& atlas;
    const Texels& texels;
    const RayScene& rays;
    bool lifts_smooth = true;  ///< see GatherSettings
};

/// The part of a texel that takes light from these panels: what find_exposures() left free of its front, or its back
/// where it may turn and only that can be lit. Smooth pieces of the front are lifted (lift_pieces.h).
TexelSurface exposed_surface(const Receivers& receivers, const Texel& texel, std::span<const Panel> panels);

/// m^2 of a texel that is free: its area less what is inside other geometry.
double exposed_area(const Receivers& receivers, const Texel& texel);

/// E (M1) of all panels at unit radiance.
double unshadowed_at(std::span<const Panel> panels, const RayScene& rays, const SurfacePoint& point);

/// Is some corner of it in front of a panel that is above its horizon?
bool has_lit_corner(std::span<const Panel> panels, const RayScene& rays, const TexelSurface& surface);

}  // namespace surimi
