// SPDX-License-Identifier: Apache-2.0
// A tree of border edges by place, direction and shading normal: which edges may run along another.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "baker/post/border_edges.h"

namespace surimi {

class BorderTree {
  public:
    /// `normal_chord`: the largest difference of unit normals that is asked for. The edges must outlive the tree.
    /// n log n.
    BorderTree(std::span<const BorderEdge> edges, double normal_chord);

    /// Calls `visit` with the numbers of edges that run against the edge, near it to its tolerance, with similar
    /// normals, and that are not shorter; maybe with others. Always in the same order. Stops when `visit` says no.
    void visit_opposite(const BorderEdge& edge, const std::function<bool(uint32_t)>& visit) const;

  private:
    static constexpr size_t axes = 9;  // of places, directions and normals
    struct Box {
        std::array<double, axes> low;
        std::array<double, axes> high;
    };
    struct Node {
        Box box;
        double longest = 0;  // metres
        uint32_t first = 0;  // of a leaf, in order_
        uint32_t count = 0;  // 0: an inner node, whose children are the next one and `right`
        uint32_t right = 0;
    };

    static Box box_of(const BorderEdge& edge);
    uint32_t build(uint32_t first, uint32_t count);

    std::span<const BorderEdge> edges_;
    double normal_chord_;
    double extent_ = 0;  // of all places, metres
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace surimi
