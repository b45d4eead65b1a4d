// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/lift_pieces.h"

#include <algorithm>

#include "baker/texel/lift.h"

namespace surimi {
namespace {

// Lifts. What is farther away hides light that is moved by at most its inverse, in radians.
constexpr double reach = 16;

bool is_way_free(const RayScene& rays, const TexelSurface::Piece& piece, const TexelSurface::Affine& lifted) {
    TexelSurface::Piece moved = piece;
    moved.position = lifted;
    moved.is_lifted = true;
    const auto is_free = [&](const Vec2& uv) {
        const Vec3 from = rays.ray_origin(TexelSurface::point_of(piece, uv)) - rays.center();
        const Vec3 to = rays.ray_origin(TexelSurface::point_of(moved, uv)) - rays.center();
        return !rays.is_occluded_until(1, from, to, RayScene::no_monitor);
    };
    return is_free(piece.middle()) && is_free({0, 0}) && is_free({1, 0}) && is_free({1, 1}) &&
           (!piece.is_square || is_free({0, 1}));
}

/// Would the piece look over something on its way to the light? Rays from its middle on its facet, to the middles and
/// corners of panels, no flatter than the facet.
bool is_beside_something(const RayScene& rays, std::span<const Panel> panels, const TexelSurface::Piece& piece,
                         const TexelSurface::Affine& lifted) {
    const Vec2 middle = piece.middle();
    const Vec3 origin = rays.ray_origin(TexelSurface::point_of(piece, middle)) - rays.center();
    const double near = reach * glm::length(lifted.at(middle.x, middle.y) - piece.position.at(middle.x, middle.y));
    const auto is_hidden = [&](const Panel& panel, const Vec3& place) {
        Vec3 way = place - origin;
        way -= std::min(0.0, glm::dot(way, piece.geometric_normal)) * piece.geometric_normal;
        const double length = glm::length(way), end = std::min(near / length, end_of_rays(panel, origin));
        return length > 0 && rays.is_occluded_until(end, origin, origin + way, RayScene::no_monitor);
    };
    return std::ranges::any_of(panels, [&](const Panel& panel) {
        return is_hidden(panel, panel.center) ||
               std::ranges::any_of(panel.places, [&](const Vec3& place) { return is_hidden(panel, place); });
    });
}

}  // namespace

void lift_pieces(const RayScene& rays, std::span<const Panel> panels, TexelSurface& surface) {
    for (size_t i = 0; i < surface.pieces().size(); ++i) {
        const TexelSurface::Piece& piece = surface.pieces()[i];
        if (piece.has_one_normal) continue;
        const auto round = round_triangle(surface.scene().surfaces[piece.triangle.surface], piece.triangle.triangle);
        if (!round) continue;
        const auto lifted = lifted_position(*round, piece);
        if (lifted && is_way_free(rays, piece, *lifted) && !is_beside_something(rays, panels, piece, *lifted))
            surface.lift(i, *lifted);
    }
}

}  // namespace surimi
