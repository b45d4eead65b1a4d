// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include "baker/gather/box_tree.h"

namespace surimi {
namespace {

/// Bit p: plane p of the shaft may still cut what is being tested. Planes beyond the 64th are left out: then more is
/// found than need be.
using PlaneMask = uint64_t;

size_t first_of(PlaneMask mask) {
    return static_cast<size_t>(std::countr_zero(mask));
}

PlaneMask all_planes(const Shaft& shaft) {
    return shaft.planes.size() >= 64 ? ~PlaneMask{0} : (PlaneMask{1} << shaft.planes.size()) - 1;
}

/// Does the shaft miss the box for certain? Clears the planes that have all of the box inside.
bool misses(const Shaft& shaft, const Vec3f& low, const Vec3f& high, PlaneMask& mask) {
    for (int axis = 0; axis < 3; ++axis)
        if (low[axis] > shaft.high[axis] || high[axis] < shaft.low[axis]) return true;
    const Vec3 center = 0.5 * (Vec3(low) + Vec3(high)), half = 0.5 * (Vec3(high) - Vec3(low));
    PlaneMask cutting = 0;
    for (PlaneMask rest = mask; rest != 0; rest &= rest - 1) {
        const Shaft::Plane& plane = shaft.planes[first_of(rest)];
        const double middle = glm::dot(plane.normal, center) + plane.offset;
        const double reach = glm::dot(glm::abs(plane.normal), half);
        if (middle < -reach) return true;
        if (middle < reach) cutting |= rest & (~rest + 1);
    }
    mask = cutting;
    return false;
}

/// Is every face at the edges below seen from the front by the whole block, or every one from behind? Directions from
/// the node to the block lie in a cone around that between their centres; so do the normals.
bool is_turned(const Shaft& shaft, const EdgeNode& node) {
    if (node.cosine <= 0) return false;
    const Vec3 center = 0.5 * (Vec3(node.low) + Vec3(node.high));
    const Vec3 way = shaft.block_center - center;
    const double reach = shaft.block_radius + 0.5 * glm::length(Vec3(node.high) - Vec3(node.low)) + shaft.margin;
    const double square = glm::dot(way, way);
    if (!(square > reach * reach)) return false;
    const double along = std::abs(glm::dot(Vec3(node.axis), way));
    const double away = std::sqrt(square - reach * reach);  // distance times the cosine of the directions' half angle
    const double cosine = node.cosine, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    // The sum of both half angles is below 90 degrees, and the axes' angle below what is left.
    return cosine * away > sine * reach && along > sine * away + cosine * reach;
}

bool is_outside(const Shaft::Plane& plane, const Vec3f& place) {
    return glm::dot(plane.normal, Vec3(place)) + plane.offset < 0;
}

/// Does the edge meet the insides of these planes?
bool meets(const Shaft& shaft, const Edge& edge, PlaneMask mask) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::min(edge.a[axis], edge.b[axis]) > shaft.high[axis] ||
            std::max(edge.a[axis], edge.b[axis]) < shaft.low[axis])
            return false;
    const Vec3 a(edge.a), b(edge.b);
    double begin = 0, end = 1;
    for (; mask != 0; mask &= mask - 1) {
        const Shaft::Plane& plane = shaft.planes[first_of(mask)];
        const double from = glm::dot(plane.normal, a) + plane.offset, to = glm::dot(plane.normal, b) + plane.offset;
        if (from < 0 && to < 0) return false;
        if (from < 0) begin = std::max(begin, from / (from - to));
        if (to < 0) end = std::min(end, from / (from - to));
        if (begin > end) return false;
    }
    return true;
}

/// 1: the whole block is in front of the plane; -1: behind; 0: neither, or too close to tell.
int side_of_block(const Shaft& shaft, const FacePlane& plane) {
    const double middle = glm::dot(plane.normal, shaft.block_center) - plane.distance;
    if (std::abs(middle) > shaft.block_radius + shaft.margin) return middle > 0 ? 1 : -1;
    bool is_front = true, is_back = true;
    for (const Vec3& corner : shaft.block) {
        const double side = glm::dot(plane.normal, corner) - plane.distance;
        is_front = is_front && side > shaft.margin;
        is_back = is_back && side < -shaft.margin;
    }
    return is_front ? 1 : is_back ? -1 : 0;
}

/// Is the edge a silhouette from no point of the block (M50)?
bool is_never_silhouette(const Silhouettes& silhouettes, const Shaft& shaft, const Edge& edge) {
    if (!edge.has_second()) return false;
    const int first = side_of_block(shaft, silhouettes.planes[edge.first()]);
    if (first == 0) return false;
    const int second = side_of_block(shaft, silhouettes.planes[edge.second()]);
    return second == (edge.runs_alike() ? -first : first);
}

/// Calls `leaf(node, planes that may cut it)` for every leaf that the shaft may meet and `is_passed(node)` is not true
/// of, from left to right, until one returns true; then returns true.
template <class Passed, class Leaf>
bool walk(const std::vector<EdgeNode>& nodes, const Shaft& shaft, const Passed& is_passed, const Leaf& leaf) {
    struct Entry {
        uint32_t node;
        PlaneMask mask;
    };
    std::array<Entry, deepest_node + 1> stack;
    size_t size = 0;
    if (!nodes.empty()) stack[size++] = {0, all_planes(shaft)};
    while (size > 0) {
        auto [index, mask] = stack[--size];
        const EdgeNode& node = nodes[index];
        if (misses(shaft, node.low, node.high, mask) || is_passed(node)) continue;
        if (node.count > 0) {
            if (leaf(node, mask)) return true;
            continue;
        }
        stack[size++] = {node.first, mask};
        stack[size++] = {index + 1, mask};
    }
    return false;
}

}  // namespace

void find_candidates(const Silhouettes& silhouettes, const Shaft& shaft, size_t monitor, std::vector<uint32_t>& found) {
    found.clear();
    const auto leaf = [&](const EdgeNode& node, PlaneMask mask) {
        for (uint32_t e = node.first; e < node.first + node.count; ++e) {
            const Edge& edge = silhouettes.edges[e];
            if (edge.owner() == monitor || !meets(shaft, edge, mask)) continue;
            if (!is_never_silhouette(silhouettes, shaft, edge)) found.push_back(e);
        }
        return false;
    };
    walk(
        silhouettes.nodes, shaft, [&](const EdgeNode& node) { return is_turned(shaft, node); }, leaf);
}

bool meets_rim(const Silhouettes& silhouettes, const Shaft& shaft, uint32_t plane) {
    const auto leaf = [&](const EdgeNode& node, PlaneMask mask) {
        for (uint32_t e = node.first; e < node.first + node.count; ++e) {
            const Edge& edge = silhouettes.edges[e];
            if ((edge.first() == plane || edge.second() == plane) && meets(shaft, edge, mask)) return true;
        }
        return false;
    };
    return walk(
        silhouettes.nodes, shaft, [](const EdgeNode&) { return false; }, leaf);
}

bool meets_cutout(const Silhouettes& silhouettes, const Shaft& shaft) {
    const auto leaf = [&](const EdgeNode& node, PlaneMask mask) {
        for (uint32_t t = node.first; t < node.first + node.count; ++t) {
            const auto& [a, b, c] = silhouettes.cutouts[t];
            const Vec3f low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
            PlaneMask cutting = mask;
            if (misses(shaft, low, high, cutting)) continue;
            bool is_beyond = false;  // one of the planes has all corners outside
            for (; cutting != 0 && !is_beyond; cutting &= cutting - 1) {
                const Shaft::Plane& plane = shaft.planes[first_of(cutting)];
                is_beyond = is_outside(plane, a) && is_outside(plane, b) && is_outside(plane, c);
            }
            if (!is_beyond) return true;
        }
        return false;
    };
    return walk(
        silhouettes.cutout_nodes, shaft, [](const EdgeNode&) { return false; }, leaf);
}

}  // namespace surimi
