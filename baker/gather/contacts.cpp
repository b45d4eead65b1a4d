// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/contacts.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

// A share of the texel that matters to no error that can be asked for.
constexpr double least_part = 1e-4;

struct Box {
    Vec3 low{INFINITY}, high{-INFINITY};
    void add(const Vec3& place) { low = glm::min(low, place), high = glm::max(high, place); }
};

bool meet(const Vec3& low, const Vec3& high, const Box& box) {
    return low.x <= box.high.x && low.y <= box.high.y && low.z <= box.high.z && high.x >= box.low.x &&
           high.y >= box.low.y && high.z >= box.low.z;
}

/// A piece of a texel, lifted to where its rays start from.
struct LiftedPiece {
    const TexelSurface::Piece& piece;
    size_t number = 0;
    Vec3 normal{0, 0, 1};
    double lift = 0;  ///< dot(normal, place) of its plane
    Vec3 middle{0};
    double radius = 0;

    LiftedPiece(const RayScene& rays, const TexelSurface& surface, size_t index)
        : piece(surface.pieces()[index]), number(index), normal(piece.plane_normal()) {
        const Vec3 origin = rays.ray_origin(TexelSurface::point_of(piece, {0, 0})) - rays.center();
        lift = glm::dot(normal, origin);
        const Vec3 offset = origin - piece.position.origin;
        middle = piece.position.at(0.5, 0.5) + offset;
        radius = 0.5 * (glm::length(piece.position.edge_u) + glm::length(piece.position.edge_v));
    }
    double height(const Vec3& place) const { return glm::dot(normal, place) - lift; }
    void add(const Vec3& from, const Vec3& to, const Vec3& center, std::vector<TexelSurface::Crossing>& lines) const {
        if (distance_to_segment(middle, from, to) < radius) lines.push_back({number, from + center, to + center});
    }
};

void add_contact(const LiftedPiece& piece, const BoxedTriangle& triangle, double slab, const Vec3& center,
                 std::vector<TexelSurface::Crossing>& lines) {
    std::array<Vec3, 2> ends;
    size_t count = 0;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 &a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3];
        const double from = piece.height(a), to = piece.height(b);
        if ((from > 0) != (to > 0)) ends[count++] = a + (b - a) * (from / (from - to));
        const bool is_in_slab = std::min(from, to) > 0 && std::max(from, to) < slab;
        if (is_in_slab)
            piece.add(a - from * piece.piece.geometric_normal, b - to * piece.piece.geometric_normal, center, lines);
    }
    if (count == 2) piece.add(ends[0], ends[1], center, lines);
}

}  // namespace

std::vector<BoxedTriangle> triangles_around(const RayScene& rays, std::span<const Vec3> places) {
    Box box;
    for (const Vec3& place : places) box.add(place);
    const Vec3 middle = 0.5 * (box.low + box.high);
    double radius = 0;
    for (const Vec3& place : places) radius = std::max(radius, glm::length(place - middle));
    thread_local std::vector<TriangleRef> near;
    rays.find_triangles_near(middle, radius, near);
    std::vector<BoxedTriangle> found;
    for (const TriangleRef& ref : near) {
        const auto corners = rays.corners_of(ref);
        const BoxedTriangle triangle{corners, glm::min(corners[0], glm::min(corners[1], corners[2])),
                                     glm::max(corners[0], glm::max(corners[1], corners[2]))};
        if (meet(triangle.low, triangle.high, box)) found.push_back(triangle);
    }
    return found;
}

void find_contacts(const RayScene& rays, std::span<const BoxedTriangle> triangles, const TexelSurface& surface,
                   double slab, std::vector<TexelSurface::Crossing>& lines) {
    lines.clear();
    if (triangles.empty() || surface.pieces().size() > most_parts_of_texel) return;
    Box box;
    surface.for_each_corner([&](const SurfacePoint& corner) {
        const Vec3 place = rays.ray_origin(corner) - rays.center();
        box.add(place);
        if (slab > 0) box.add(place + slab * corner.geometric_normal);
    });
    thread_local std::vector<const BoxedTriangle*> near;
    near.clear();
    for (const BoxedTriangle& triangle : triangles)
        if (meet(triangle.low, triangle.high, box)) near.push_back(&triangle);
    for (size_t i = 0; i < surface.pieces().size() && !near.empty(); ++i) {
        const LiftedPiece piece(rays, surface, i);
        for (const BoxedTriangle* triangle : near) add_contact(piece, *triangle, slab, rays.center(), lines);
    }
}

TexelSurface::CutResult cut_along(std::span<const TexelSurface::Crossing> contacts, TexelSurface& surface) {
    return surface.cut(contacts, least_part, most_parts_of_texel);
}

TexelSurface::CutResult cut_at_contacts(const RayScene& rays, std::span<const BoxedTriangle> triangles,
                                        TexelSurface& surface) {
    thread_local std::vector<TexelSurface::Crossing> lines;
    find_contacts(rays, triangles, surface, 0, lines);
    return cut_along(lines, surface);
}

}  // namespace surimi
