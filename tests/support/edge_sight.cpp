// SPDX-License-Identifier: Apache-2.0
#include "tests/support/edge_sight.h"

#include <algorithm>

namespace surimi::test {
namespace {

int side_of(const FacePlane& plane, const Vec3& p) {
    return glm::dot(plane.normal, p) > plane.distance ? 1 : -1;
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c) {
    return glm::dot(glm::cross(a, b), c);
}

}  // namespace

int jump_at(const Silhouettes& silhouettes, const Edge& edge, const Vec3& p) {
    const int first = side_of(silhouettes.planes[edge.first()], p);
    if (!edge.has_second()) return first;
    const int second = side_of(silhouettes.planes[edge.second()], p);
    return edge.runs_alike() ? first + second : first - second;
}

bool is_before(const Vec3& p, std::span<const Vec3> panel, const Vec3& a, const Vec3& b, double slack) {
    Vec3 middle(0);
    for (const Vec3& corner : panel) middle += corner / static_cast<double>(panel.size());
    double begin = 0, end = 1;
    const auto clip = [&](const Vec3& origin, const Vec3& area) {
        Vec3 normal = glm::normalize(area);
        if (glm::dot(normal, 0.5 * (p + middle) - origin) < 0) normal = -normal;
        const double from = glm::dot(normal, a - origin) + slack, to = glm::dot(normal, b - origin) + slack;
        if (from < 0 && to < 0) begin = 2;
        if (from < 0 && to >= 0) begin = std::max(begin, from / (from - to));
        if (to < 0 && from >= 0) end = std::min(end, from / (from - to));
    };
    for (size_t k = 0; k < panel.size(); ++k) clip(p, glm::cross(panel[k] - p, panel[(k + 1) % panel.size()] - p));
    clip(panel[0], area_normal(panel[0], panel[1], panel[2]));
    return begin < end;
}

int depth_complexity(const Scene& scene, const Vec3& center, const Vec3& p, const Vec3& q) {
    int count = 0;
    for (const Surface& surface : scene.surfaces)
        for (const auto& triangle : surface.triangles) {
            std::array<Vec3, 3> c;
            for (size_t k = 0; k < 3; ++k) c[k] = Vec3(Vec3f(surface.positions[triangle[k]] - center)) - p;
            const Vec3 way = q - p;
            const double u = volume(c[0], c[1], way), v = volume(c[1], c[2], way), w = volume(c[2], c[0], way);
            if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
            const Vec3 normal = area_normal(c[0], c[1], c[2]);
            const double at = glm::dot(normal, c[0]) / glm::dot(normal, way);
            if (at > 0 && at < 1) ++count;
        }
    return count;
}

}  // namespace surimi::test
