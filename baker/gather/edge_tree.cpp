// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "baker/gather/box_tree.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr float no_cone = -2;
constexpr double rounding = 1e-6;  // of axes and cosines stored as float, with a factor of ten to spare

void set_cone(EdgeNode& node, const Vec3& axis, double cosine) {
    node.axis = Vec3f(axis);
    node.cosine = cosine > 0 ? static_cast<float>(cosine - rounding) : no_cone;  // beyond 90 degrees it culls nothing
}

/// Normals turned so that an edge is no silhouette where all of them are seen from the same side (M50).
void set_leaf_cone(const Silhouettes& silhouettes, EdgeNode& node) {
    const auto second_of = [&](const Edge& edge) {
        return silhouettes.planes[edge.second()].normal * (edge.runs_alike() ? -1.0 : 1.0);
    };
    node.cosine = no_cone;
    Vec3 sum(0);
    for (uint32_t e = node.first; e < node.first + node.count; ++e) {
        const Edge& edge = silhouettes.edges[e];
        if (!edge.has_second()) return;
        sum += silhouettes.planes[edge.first()].normal + second_of(edge);
    }
    const double length = glm::length(sum);
    if (!(length > rounding)) return;
    const Vec3 axis = sum / length;
    double cosine = 1;
    for (uint32_t e = node.first; e < node.first + node.count; ++e) {
        const Edge& edge = silhouettes.edges[e];
        cosine = std::min(
            {cosine, glm::dot(axis, silhouettes.planes[edge.first()].normal), glm::dot(axis, second_of(edge))});
    }
    set_cone(node, axis, cosine);
}

double half_angle(const EdgeNode& node) {
    const double cosine = node.cosine;
    return std::atan2(std::sqrt(std::max(0.0, 1 - cosine * cosine)), cosine);
}

/// The smallest cone around both children's.
void set_inner_cone(EdgeNode& node, const EdgeNode& left, const EdgeNode& right) {
    node.cosine = no_cone;
    if (left.cosine <= no_cone || right.cosine <= no_cone) return;
    const EdgeNode& wide = left.cosine <= right.cosine ? left : right;
    const EdgeNode& slim = left.cosine <= right.cosine ? right : left;
    const Vec3 axis = normalize_or(Vec3(wide.axis), Vec3(0, 0, 1)), other = normalize_or(Vec3(slim.axis), axis);
    const double between = std::atan2(glm::length(glm::cross(axis, other)), glm::dot(axis, other));
    const double wide_angle = half_angle(wide), slim_angle = half_angle(slim);
    if (between + slim_angle <= wide_angle) return set_cone(node, axis, std::cos(wide_angle));
    const double angle = 0.5 * (wide_angle + between + slim_angle);
    const Vec3 across = normalize_or(other - axis * glm::dot(axis, other), Vec3(0));
    const double turn = angle - wide_angle;
    if (angle < 0.5 * pi) set_cone(node, axis * std::cos(turn) + across * std::sin(turn), std::cos(angle));
}

}  // namespace

void build_tree(Silhouettes& silhouettes) {
    std::vector<EdgeNode>& nodes = silhouettes.nodes;
    nodes = build_boxes(silhouettes.edges);
    parallel_for(nodes.size(), 1024, [&](size_t n) {
        if (nodes[n].count > 0) set_leaf_cone(silhouettes, nodes[n]);
    });
    for (size_t n = nodes.size(); n-- > 0;)  // children stand behind their parents
        if (nodes[n].count == 0) set_inner_cone(nodes[n], nodes[n + 1], nodes[nodes[n].first]);
}

}  // namespace surimi
