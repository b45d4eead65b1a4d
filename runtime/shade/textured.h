// SPDX-License-Identifier: Apache-2.0
// Which part of a monitor's picture a lobe sees.
#pragma once

#include <span>
#include <vector>

#include "runtime/light/lit_monitor.h"

namespace surimi {

/// A part of a monitor's panel that is shaded on its own.
struct LightPiece {
    size_t panel = 0;           ///< index into Monitor::panels
    std::vector<Vec3> corners;  ///< as those of a Polygon
};

/// The panels of a monitor, each that has four corners cut into `cells` x `cells`: a blurred lookup for each follows
/// what a lobe sees of the picture better than one for all (M33). One piece a panel for `cells` = 1.
std::vector<LightPiece> pieces_of(const Monitor& monitor, int cells);

/// Mean of the picture on a piece of a panel as a clamped-cosine lobe sees it (M33): the picture blurred around the
/// place on the panel to which the lobe's share of the light points, as wide as the lobe is there. `to_cosine` brings
/// world directions into the space of the lobe, where it is a cosine around +z; it is cut at the horizon there. `point`
/// in the world, metres. Times the share of the piece it is what the textured piece sends.
Vec3 picture_seen(const MonitorPicture& picture, size_t panel, std::span<const Vec3> corners, const Vec3& point,
                  const Mat3& to_cosine);

}  // namespace surimi
