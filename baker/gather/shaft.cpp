// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "baker/gather/silhouettes.h"

namespace surimi {
namespace {

constexpr double flat = 1e-9;            // of `scale`: corners this close to a plane lie in it
constexpr double slim = 1e-9;            // sine: three points that lie in a line but for this span no plane
constexpr double equal_normals = 1e-12;  // 1 - cosine

struct Hull {
    Shaft& shaft;
    double tolerance = 0;
};

/// Adds the side of the plane, unless a plane of the same direction bounds it already. `lowest`: of the corners, as
/// normal.x, so that the side holds them all however the plane was rounded.
void add_side(Hull& hull, const Vec3& normal, double lowest) {
    for (const Shaft::Plane& plane : hull.shaft.planes)
        if (glm::dot(plane.normal, normal) > 1 - equal_normals) return;
    hull.shaft.planes.push_back({normal, hull.shaft.margin - lowest});
}

/// Adds the plane's sides that hold all corners, if there are any.
void try_plane(Hull& hull, const Vec3& origin, const Vec3& normal) {
    double low = 0, high = 0;
    for (const std::vector<Vec3>* corners : {&hull.shaft.panel, &hull.shaft.block})
        for (const Vec3& corner : *corners) {
            const double side = glm::dot(normal, corner - origin);
            low = std::min(low, side);
            high = std::max(high, side);
            if (low < -hull.tolerance && high > hull.tolerance) return;
        }
    const double at = glm::dot(normal, origin);
    if (low >= -hull.tolerance) add_side(hull, normal, at + low);
    if (high <= hull.tolerance) add_side(hull, -normal, -(at + high));
}

void try_triangle(Hull& hull, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a, normal = glm::cross(u, v);
    const double square = glm::dot(normal, normal);
    if (!(square > slim * slim * glm::dot(u, u) * glm::dot(v, v))) return;
    try_plane(hull, a, normal / std::sqrt(square));
}

void set_bounds(Shaft& shaft) {
    shaft.low = Vec3(std::numeric_limits<double>::infinity());
    shaft.high = -shaft.low;
    Vec3 low = shaft.low, high = shaft.high;
    for (const Vec3& corner : shaft.block) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    shaft.block_center = 0.5 * (low + high);
    for (const Vec3& corner : shaft.block)
        shaft.block_radius = std::max(shaft.block_radius, glm::length(corner - shaft.block_center));
    for (const Vec3& corner : shaft.panel) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    shaft.low = low - shaft.margin;
    shaft.high = high + shaft.margin;
}

}  // namespace

Shaft make_shaft(std::span<const Vec3> block, std::span<const Vec3> panel, double scale) {
    Shaft shaft;
    shaft.block.assign(block.begin(), block.end());
    shaft.panel.assign(panel.begin(), panel.end());
    shaft.margin = 2 * scale * std::numeric_limits<float>::epsilon();
    shaft.planes.reserve(2 * (block.size() + panel.size()));
    set_bounds(shaft);

    // Every facet of the hull holds an edge or a pair of corners of one and a corner of the other, or is of one alone.
    // All such planes are tried: their number is small, and no assumption on how the corners are joined can fail.
    Hull hull{shaft, flat * scale};
    for (size_t k = 0; k < panel.size(); ++k)
        for (const Vec3& corner : block) try_triangle(hull, panel[k], panel[(k + 1) % panel.size()], corner);
    for (size_t i = 0; i < block.size(); ++i)
        for (size_t j = i + 1; j < block.size(); ++j)
            for (const Vec3& corner : panel) try_triangle(hull, block[i], block[j], corner);
    for (size_t k = 1; k + 1 < panel.size(); ++k) try_triangle(hull, panel[0], panel[k], panel[k + 1]);
    for (size_t i = 0; i < block.size(); ++i)
        for (size_t j = i + 1; j < block.size(); ++j)
            for (size_t k = j + 1; k < block.size(); ++k) try_triangle(hull, block[i], block[j], block[k]);
    return shaft;
}

}  // namespace surimi
