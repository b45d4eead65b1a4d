// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/lift_pieces.h"

#include "baker/texel/lift.h"

namespace surimi {
namespace {

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

}  // namespace

void lift_pieces(const RayScene& rays, TexelSurface& surface) {
    for (size_t i = 0; i < surface.pieces().size(); ++i) {
        const TexelSurface::Piece& piece = surface.pieces()[i];
        if (piece.has_one_normal) continue;
        const auto round = round_triangle(surface.scene().surfaces[piece.triangle.surface], piece.triangle.triangle);
        if (!round) continue;
        const auto lifted = lifted_position(*round, piece);
        if (lifted && is_way_free(rays, piece, *lifted)) surface.lift(i, *lifted);
    }
}

}  // namespace surimi
