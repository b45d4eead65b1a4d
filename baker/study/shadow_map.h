// SPDX-License-Identifier: Apache-2.0
// Ray-free estimates of visibility from a depth map: what real-time renderers do.
#pragma once

#include <vector>

#include "baker/study/depth_map.h"

namespace surimi {

/// The depth maps of a monitor: of its front and, when it is two-sided, of its back.
using DepthMaps = std::vector<DepthMap>;

DepthMaps make_depth_maps(const StudiedMonitor& light, int size);

/// Percentage-closer filtering (Reeves, Salesin and Cook 1987): the share of n x n texels of the map, around the
/// receiver's, that are not nearer than the receiver; n odd, 1 is a plain shadow map. At the middle of the texel, as in
/// a shader. Depths are compared with the plane of the receiver (Isidoro 2006), so wide kernels need no bias.
StudyEstimate percentage_closer_filter(const Receiver& receiver, const DepthMaps& maps, int n);

/// Percentage-closer soft shadows (Fernando 2005): `taps` look-ups for the mean depth of what is nearer, and as many in
/// a kernel as wide as the penumbra is under a parallel blocker at that depth (M59). The near plane that sets the width
/// of the search is a quarter of the way to the receiver. At the middle of the texel.
StudyEstimate percentage_closer_soft_shadow(const Receiver& receiver, const DepthMaps& maps, int taps);

}  // namespace surimi
