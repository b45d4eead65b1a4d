// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/min_cut.h"

#include <algorithm>

namespace surimi {

void MinCut::add_edge(uint32_t a, uint32_t b, int64_t capacity) {
    arcs_.push_back({b, first_[a], capacity});
    first_[a] = static_cast<uint32_t>(arcs_.size() - 1);
    arcs_.push_back({a, first_[b], capacity});
    first_[b] = static_cast<uint32_t>(arcs_.size() - 1);
}

bool MinCut::find_levels(uint32_t from, uint32_t to) {
    level_.assign(first_.size(), no_arc);
    level_[from] = 0;
    std::vector<uint32_t> open{from};
    for (size_t i = 0; i < open.size(); ++i) {
        for (uint32_t a = first_[open[i]]; a != no_arc; a = arcs_[a].next) {
            const uint32_t head = arcs_[a].head;
            if (arcs_[a].room <= 0 || level_[head] != no_arc) continue;
            level_[head] = level_[open[i]] + 1;
            open.push_back(head);
        }
    }
    return level_[to] != no_arc;
}

/// Finds one way of rising levels with room and fills it; 0 when there is none left. Without recursion: ways are as
/// long as the mesh is wide.
int64_t MinCut::push(uint32_t from, uint32_t to) {
    std::vector<uint32_t> way;  // arcs
    uint32_t node = from;
    while (node != to) {
        uint32_t& a = current_[node];
        while (a != no_arc && (arcs_[a].room <= 0 || level_[arcs_[a].head] != level_[node] + 1)) a = arcs_[a].next;
        if (a != no_arc) {
            way.push_back(a);
            node = arcs_[a].head;
            continue;
        }
        if (way.empty()) return 0;
        level_[node] = no_arc;  // a dead end
        node = arcs_[way.back() ^ 1].head;
        way.pop_back();
    }
    int64_t room = INT64_MAX;
    for (const uint32_t a : way) room = std::min(room, arcs_[a].room);
    for (const uint32_t a : way) {
        arcs_[a].room -= room;
        arcs_[a ^ 1].room += room;
    }
    return room;
}

std::vector<bool> MinCut::separate(uint32_t from, uint32_t to) {
    while (find_levels(from, to)) {
        current_ = first_;
        while (push(from, to) > 0) {
        }
    }
    std::vector<bool> stays(first_.size());
    for (size_t i = 0; i < stays.size(); ++i) stays[i] = level_[i] != no_arc;
    return stays;
}

}  // namespace surimi
