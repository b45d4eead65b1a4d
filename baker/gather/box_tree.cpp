// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/box_tree.h"

#include <algorithm>
#include <limits>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr size_t leaf_size = 8;
constexpr size_t bin_count = 16;
constexpr size_t deepest_heuristic = 48;  // below, halves: 48 more levels hold more items than there can be

struct Box {
    Vec3f low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
};

inline void grow(Box& box, const Vec3f& place) {
    box.low = glm::min(box.low, place);
    box.high = glm::max(box.high, place);
}

inline void grow(Box& box, const Box& other) {
    box.low = glm::min(box.low, other.low);
    box.high = glm::max(box.high, other.high);
}

Box box_of(const Edge& edge) {
    return {glm::min(edge.a, edge.b), glm::max(edge.a, edge.b)};
}

Box box_of(const std::array<Vec3f, 3>& triangle) {
    return {glm::min(triangle[0], glm::min(triangle[1], triangle[2])),
            glm::max(triangle[0], glm::max(triangle[1], triangle[2]))};
}

Vec3f middle(const Box& box) {
    return 0.5f * box.low + 0.5f * box.high;
}

double surface(const Box& box) {
    const Vec3 size = Vec3(box.high) - Vec3(box.low);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

struct Bin {
    Box box;
    size_t count = 0;
};

/// Which of the bins along an axis the middle of an item falls into.
struct Binning {
    int axis = 0;
    float low = 0, scale = 0;

    size_t operator()(const Vec3f& place) const {
        const float bin = (place[axis] - low) * scale;
        return bin > 0 ? std::min(static_cast<size_t>(bin), bin_count - 1) : 0;
    }
};

struct Split {
    double cost = std::numeric_limits<double>::infinity();
    Binning binning;
    size_t bin = 0;  ///< the first of the right side
};

void consider(const std::array<Bin, bin_count>& bins, const Binning& binning, Split& best) {
    std::array<double, bin_count> right_costs{};
    Box box;
    size_t count = 0;
    for (size_t b = bin_count; b-- > 1;) {
        grow(box, bins[b].box);
        count += bins[b].count;
        right_costs[b] =
            count == 0 ? std::numeric_limits<double>::infinity() : surface(box) * static_cast<double>(count);
    }
    box = {};
    count = 0;
    for (size_t b = 1; b < bin_count; ++b) {
        grow(box, bins[b - 1].box);
        count += bins[b - 1].count;
        if (count == 0) continue;
        const double cost = surface(box) * static_cast<double>(count) + right_costs[b];
        if (cost < best.cost) best = {cost, binning, b};
    }
}

template <class Item>
Split best_split(const Item* items, size_t count, const Box& middles) {
    std::array<std::array<Bin, bin_count>, 3> bins;
    std::array<Binning, 3> binnings;
    for (int axis = 0; axis < 3; ++axis) {
        const float size = middles.high[axis] - middles.low[axis];
        const float scale = static_cast<float>(bin_count) / size;
        binnings[static_cast<size_t>(axis)] = {axis, middles.low[axis], size > 0 && std::isfinite(scale) ? scale : 0};
    }
    for (size_t i = 0; i < count; ++i) {
        const Box box = box_of(items[i]);
        const Vec3f place = middle(box);
        for (size_t axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[axis][binnings[axis](place)];
            grow(bin.box, box);
            ++bin.count;
        }
    }
    Split best;
    for (size_t axis = 0; axis < 3; ++axis) consider(bins[axis], binnings[axis], best);
    return best;
}

/// A range of items that is to become a subtree.
struct Range {
    size_t begin = 0, end = 0, depth = 0;
};

/// Bounds of a range's items, and where it is divided.
struct Division {
    Box box;
    size_t middle = 0;
};

template <class Item>
Division divide(std::vector<Item>& items, const Range& range) {
    Division division;
    Box middles;
    for (size_t i = range.begin; i < range.end; ++i) {
        const Box box = box_of(items[i]);
        grow(division.box, box);
        grow(middles, middle(box));
    }
    const size_t count = range.end - range.begin;
    if (count <= leaf_size) return division;
    division.middle = range.begin + count / 2;
    const auto at = [&](size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    if (range.depth < deepest_heuristic) {
        const Split split = best_split(&items[range.begin], count, middles);
        if (split.cost == std::numeric_limits<double>::infinity()) return division;  // all in one place: any halves do
        const auto right = std::partition(at(range.begin), at(range.end), [&](const Item& item) {
            return split.binning(middle(box_of(item))) < split.bin;
        });
        division.middle = static_cast<size_t>(right - items.begin());
        return division;
    }
    const Vec3f size = middles.high - middles.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(at(range.begin), at(division.middle), at(range.end),
                     [&](const Item& a, const Item& b) { return middle(box_of(a))[axis] < middle(box_of(b))[axis]; });
    return division;
}

EdgeNode node_of(const Box& box) {
    EdgeNode node;
    node.low = box.low;
    node.high = box.high;
    return node;
}

/// Appends the subtree of a range.
template <class Item>
void append(std::vector<Item>& items, const Range& range, std::vector<EdgeNode>& nodes) {
    const size_t count = range.end - range.begin, index = nodes.size();
    const Division division = divide(items, range);
    nodes.push_back(node_of(division.box));
    if (count <= leaf_size) {
        nodes[index].first = static_cast<uint32_t>(range.begin);
        nodes[index].count = static_cast<uint32_t>(count);
        return;
    }
    append(items, {range.begin, division.middle, range.depth + 1}, nodes);
    nodes[index].first = static_cast<uint32_t>(nodes.size());
    append(items, {division.middle, range.end, range.depth + 1}, nodes);
}

/// Appends a subtree that was built on its own.
void append(const std::vector<EdgeNode>& subtree, std::vector<EdgeNode>& nodes) {
    const auto base = static_cast<uint32_t>(nodes.size());
    for (EdgeNode node : subtree) {
        if (node.count == 0) node.first += base;
        nodes.push_back(node);
    }
}

/// The subtree of a range, its halves in parallel while they are large.
template <class Item>
std::vector<EdgeNode> build(std::vector<Item>& items, const Range& range) {
    constexpr size_t task_size = 1 << 14;
    std::vector<EdgeNode> nodes;
    if (range.end - range.begin <= task_size) {
        append(items, range, nodes);
        return nodes;
    }
    const Division division = divide(items, range);
    const std::array<Range, 2> halves = {Range{range.begin, division.middle, range.depth + 1},
                                         Range{division.middle, range.end, range.depth + 1}};
    std::array<std::vector<EdgeNode>, 2> subtrees;
    parallel_for(2, 1, [&](size_t half) { subtrees[half] = build(items, halves[half]); });
    nodes.reserve(1 + subtrees[0].size() + subtrees[1].size());
    nodes.push_back(node_of(division.box));
    append(subtrees[0], nodes);
    nodes[0].first = static_cast<uint32_t>(nodes.size());
    append(subtrees[1], nodes);
    return nodes;
}

template <class Item>
std::vector<EdgeNode> build(std::vector<Item>& items) {
    if (items.empty()) return {};
    std::vector<EdgeNode> nodes = build(items, {0, items.size(), 0});
    nodes.shrink_to_fit();
    return nodes;
}

}  // namespace

std::vector<EdgeNode> build_boxes(std::vector<Edge>& items) {
    return build(items);
}

std::vector<EdgeNode> build_boxes(std::vector<std::array<Vec3f, 3>>& items) {
    return build(items);
}

}  // namespace surimi
