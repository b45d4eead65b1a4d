// SPDX-License-Identifier: Apache-2.0
// Surfaces -> the pages of an atlas, by what they will need of the maps.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "baker/unwrap/fit.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// Texels that charts and their gutters take, by the density d in texels per metre. A chart in a box of w x h metres
/// takes about A d^2 + (w + h) m d + m^2, m being the gutter and the one texel by which touched ones exceed covered
/// ones.
struct Need {
    double per_square = 0;
    double per_metre = 0;
    double always = 0;

    double at(double density) const { return (per_square * density + per_metre) * density + always; }
    Need& operator+=(const Need& other);
    Need& operator-=(const Need& other);
};

/// The density at which so many texels are needed; 0 when there is none.
double density_of(const Need& need, double texels);

/// Of each of `surface_count` surfaces.
std::vector<Need> needs_of_surfaces(size_t surface_count, const FitRequest& request);

/// Surfaces on pages. All charts of a surface lie on one page, because its material carries one texture.
struct Pages {
    std::vector<int> of_surface;
    std::vector<double> densities;  ///< of each page: texels per metre of charts of factor 1, as last packed
};

/// Chooses the page of each surface, for at most settings.atlases pages; each page has a surface, and the pages are
/// numbered in the order of their first ones. They get about the same number of texels (greedily, largest surface
/// first: Graham 1969); where that costs nothing, surfaces of one node or material share a page. There are fewer pages
/// than asked for where more would not help: a surface that is larger than the others together fills one alone.
std::vector<int> spread_over_pages(const Scene& scene, const std::vector<Need>& needs, const UnwrapSettings& settings);

/// The page with the lowest density among those that several surfaces share; -1: none is shared.
int tightest_page(const Pages& pages, const std::vector<Need>& needs);

using Move = std::pair<uint32_t, int>;  ///< a surface, and its new page

/// The move of one surface off the tightest page that should raise the lowest density most, if any should. Supposes
/// that pages stay as well filled as they are.
std::optional<Move> best_move(const Pages& pages, const std::vector<Need>& needs, const std::set<Move>& excluded);

}  // namespace surimi
