// SPDX-License-Identifier: Apache-2.0
// Silhouettes as a point sees them on a panel: the candidates of a block, classified, projected and clipped in SIMD.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baker/gather/panel.h"
#include "baker/gather/silhouettes.h"

namespace surimi {

/// A block's candidates, structure of arrays, padded with edges that are never seen.
struct Candidates {
    std::vector<double> ax, ay, az, bx, by, bz;
    std::vector<double> nx, ny, nz, nd;  ///< plane of the first face
    std::vector<double> mx, my, mz, md;  ///< plane of the second
    std::vector<double> second;          ///< what the second face's side counts: -1, +1, or 0 without one
    size_t count = 0;                    ///< without padding

    void assign(const Silhouettes& silhouettes, std::span<const uint32_t> edges);
    /// Adds the edges at which the panel's clearance cuts triangles open.
    void append(const Silhouettes& cuts, std::span<const uint32_t> edges);
    void finish();  ///< pads

  private:
    void add(const Silhouettes& silhouettes, uint32_t edge);
};

/// Directed segments in the panel's (s, t). Crossing one from its right to its left changes the number of occluders by
/// `jump` (M50), which is not 0.
struct Segments {
    std::vector<double> x0, y0, x1, y1;
    std::vector<double> jump;
    std::vector<double> side0, side1;  ///< side of view.open that clipped this end; -1: none, -2: the clearance
    std::vector<uint32_t> on_sides;    ///< those with an end on a side of view.open
    size_t count = 0;
};

/// The silhouettes among `candidates` inside view.open. Candidates from `first_cut` on lie in the plane of the
/// clearance and are not clipped by it.
void project(const Candidates& candidates, size_t first_cut, const PanelView& view, Segments& segments);

}  // namespace surimi
