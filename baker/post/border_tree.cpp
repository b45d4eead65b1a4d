// SPDX-License-Identifier: Apache-2.0
#include "baker/post/border_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace surimi {
namespace {

constexpr uint32_t leaf_size = 8;

}  // namespace

BorderTree::Box BorderTree::box_of(const BorderEdge& edge) {
    const Vec3 direction = edge.direction();
    const Vec3 turn = edge.normals[1] - edge.normals[0];
    // Normals between the ends lie on an arc, which rises over its chord c by less than c^2 / 4.
    const double rise = 0.25 * glm::dot(turn, turn);
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        box.low[a] = std::min(edge.ends[0][axis], edge.ends[1][axis]);
        box.high[a] = std::max(edge.ends[0][axis], edge.ends[1][axis]);
        box.low[a + 3] = box.high[a + 3] = direction[axis];
        box.low[a + 6] = std::min(edge.normals[0][axis], edge.normals[1][axis]) - rise;
        box.high[a + 6] = std::max(edge.normals[0][axis], edge.normals[1][axis]) + rise;
    }
    return box;
}

BorderTree::BorderTree(std::span<const BorderEdge> edges, double normal_chord)
    : edges_(edges), normal_chord_(normal_chord), order_(edges.size()) {
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const BorderEdge& edge : edges) {
        low = glm::min(low, glm::min(edge.ends[0], edge.ends[1]));
        high = glm::max(high, glm::max(edge.ends[0], edge.ends[1]));
    }
    if (edges.empty()) return;
    extent_ = largest_component(high - low);
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, static_cast<uint32_t>(edges.size()));
}

uint32_t BorderTree::build(uint32_t first, uint32_t count) {
    const auto number = static_cast<uint32_t>(nodes_.size());
    Node node;
    node.box.low.fill(std::numeric_limits<double>::infinity());
    node.box.high.fill(-std::numeric_limits<double>::infinity());
    std::array<double, axes> least = node.box.low, most = node.box.high;  // of the boxes' middles, doubled
    for (uint32_t i = first; i < first + count; ++i) {
        const Box box = box_of(edges_[order_[i]]);
        node.longest = std::max(node.longest, edges_[order_[i]].length);
        for (size_t a = 0; a < axes; ++a) {
            node.box.low[a] = std::min(node.box.low[a], box.low[a]);
            node.box.high[a] = std::max(node.box.high[a], box.high[a]);
            least[a] = std::min(least[a], box.low[a] + box.high[a]);
            most[a] = std::max(most[a], box.low[a] + box.high[a]);
        }
    }
    nodes_.push_back(node);
    // Along what is spread widest, the world's extent being as wide as the sphere of directions.
    size_t widest = 0;
    double width = -1;
    for (size_t a = 0; a < axes; ++a) {
        const double spread = (most[a] - least[a]) * (a < 3 && extent_ > 0 ? 2 / extent_ : 1);
        if (spread > width) width = spread, widest = a;
    }
    if (count <= leaf_size) {
        nodes_[number].first = first;
        nodes_[number].count = count;
        return number;
    }
    const auto middle = [&](uint32_t edge) {
        const Box box = box_of(edges_[edge]);
        return box.low[widest] + box.high[widest];
    };
    const uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](uint32_t a, uint32_t b) {
        const double x = middle(a), y = middle(b);
        return x != y ? x < y : a < b;
    });
    build(first, half);
    const uint32_t right = build(first + half, count - half);
    nodes_[number].right = right;
    return number;
}

void BorderTree::visit_opposite(const BorderEdge& edge, const std::function<bool(uint32_t)>& visit) const {
    if (nodes_.empty()) return;
    // Two lines that are within the tolerance of each other all along the edge differ in direction by 2 tolerances
    // over its length; twice that covers the rounding of this bound itself.
    const double turn = 4 * edge.tolerance / edge.length + 8 * std::numeric_limits<double>::epsilon();
    Box wanted = box_of(edge);
    for (size_t a = 0; a < 3; ++a) {
        const double direction = wanted.low[a + 3];
        wanted.low[a] -= edge.tolerance;
        wanted.high[a] += edge.tolerance;
        wanted.low[a + 3] = -direction - turn;
        wanted.high[a + 3] = -direction + turn;
        wanted.low[a + 6] -= normal_chord_;
        wanted.high[a + 6] += normal_chord_;
    }
    const auto is_possible = [&](const Node& node) {
        if (node.longest < edge.length) return false;
        for (size_t a = 0; a < axes; ++a)
            if (node.box.low[a] > wanted.high[a] || node.box.high[a] < wanted.low[a]) return false;
        return true;
    };
    std::array<uint32_t, 64> stack;  // halves of halves of at most 2^32 edges
    size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const uint32_t number = stack[--depth];
        const Node& node = nodes_[number];
        if (!is_possible(node)) continue;
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            if (!visit(order_[i])) return;
        if (node.count > 0) continue;
        stack[depth++] = node.right;
        stack[depth++] = number + 1;
    }
}

}  // namespace surimi
