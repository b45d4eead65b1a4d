// SPDX-License-Identifier: Apache-2.0
// The cheapest cut that separates some nodes of a graph from others.
#pragma once

#include <cstdint>
#include <vector>

namespace surimi {

class MinCut {
  public:
    explicit MinCut(uint32_t node_count) : first_(node_count, no_arc) {}

    /// An edge that costs `capacity` to cut.
    void add_edge(uint32_t a, uint32_t b, int64_t capacity);

    /// For each node whether it stays on the side of `from` when the cheapest cut separates it from `to`; of several
    /// cheapest cuts the one nearest to `from` (Dinic 1970).
    std::vector<bool> separate(uint32_t from, uint32_t to);

  private:
    static constexpr uint32_t no_arc = UINT32_MAX;
    struct Arc {
        uint32_t head;
        uint32_t next;  ///< arc of the same tail
        int64_t room;
    };
    bool find_levels(uint32_t from, uint32_t to);
    int64_t push(uint32_t from, uint32_t to);

    std::vector<uint32_t> first_;
    std::vector<Arc> arcs_;  ///< those of an edge are neighbours: 2 i and 2 i + 1
    std::vector<uint32_t> level_;
    std::vector<uint32_t> current_;
};

}  // namespace surimi
