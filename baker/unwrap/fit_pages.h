// SPDX-License-Identifier: Apache-2.0
// Charts -> their places on the pages of an atlas, as dense as the pages allow.
#pragma once

#include <vector>

#include "baker/unwrap/density.h"
#include "baker/unwrap/fit.h"
#include "baker/unwrap/spread.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Packs every page (see fit_to_map). All have one density, the highest at which each page that several surfaces share
/// has room; a surface alone on its page that does not fit at that density has the highest at which it does. With
/// settings.texels_per_metre all pages have that, and they are as large as the fullest one needs (see fit_to_density).
///
/// Empty `pages` are filled: surfaces are spread, packed, and moved one by one off the page that is the tightest while
/// that raises the density, for as long as settings.quality allows. Otherwise `pages` is how these surfaces were
/// packed before a few charts changed (see fit_near); its densities are brought up to date.
///
/// Shapes and placements are in the order of the request's charts, each placement on the page of its chart's surface.
/// Throws what the functions named throw.
Layout fit_pages(const Scene& scene, const FitRequest& request, const UnwrapSettings& settings, Pages& pages);

/// Sets the weights of the charts whose surface is alone on a page and fills it at less than the common density.
void mark_full_pages(const std::vector<FlatChart>& charts, const Pages& pages, double texels_per_metre,
                     std::vector<ChartWeight>& weights);

}  // namespace surimi
