// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/lift.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

// Light that arrives under less than this angle to the surface is below every error that can be asked for.
constexpr double least_slope = 1e-3;
constexpr double least_cosine = 0.85;

}  // namespace

Vec3 RoundTriangle::lift(const Vec3& barycentric) const {
    Vec3 sum(0);
    for (int i = 0; i < 3; ++i)
        sum += barycentric[i] * std::max(0.0, glm::dot(bulges[i], barycentric)) * normals[static_cast<size_t>(i)];
    return sum;
}

std::optional<RoundTriangle> round_triangle(const Surface& surface, uint32_t triangle) {
    const auto& corners = surface.triangles[triangle];
    const Vec3& first = surface.normals[corners[0]];
    if (first == surface.normals[corners[1]] && first == surface.normals[corners[2]]) return std::nullopt;
    RoundTriangle round;
    const auto place = [&](size_t i) { return surface.positions[corners[i]]; };
    round.geometric_normal = normalize_or(area_normal(place(0), place(1), place(2)), first);
    for (size_t i = 0; i < 3; ++i) {
        round.normals[i] = normalize_or(surface.normals[corners[i]], round.geometric_normal);
        if (!(glm::dot(round.normals[i], round.geometric_normal) >= least_cosine)) return std::nullopt;
    }
    bool rises = false;
    for (int i = 0; i < 3; ++i) {
        const auto a = static_cast<size_t>(i), b = (a + 1) % 3;
        const Vec3 side = place(b) - place(a);
        const double bulge = std::max(-glm::dot(side, round.normals[a]), glm::dot(side, round.normals[b]));
        const double least = least_slope * glm::length(side);
        if (!(std::abs(bulge) > least)) continue;
        const int j = (i + 1) % 3;
        round.bulges[i][j] = round.bulges[j][i] = bulge / (1 + glm::dot(round.normals[a], round.normals[b]));
        rises = rises || bulge > 0;
    }
    return rises ? std::optional(round) : std::nullopt;
}

std::optional<TexelSurface::Affine> lifted_position(const RoundTriangle& round, const TexelSurface::Piece& piece) {
    const auto lift_at = [&](const Vec2& uv) { return round.lift(piece.barycentric.at(uv.x, uv.y)); };
    const Vec2 middle = piece.middle();
    const Vec3 at_middle = lift_at(middle);
    const double height = glm::dot(at_middle, round.geometric_normal);
    if (!(height > 0)) return std::nullopt;
    const Vec3 a = lift_at({0, 0}), b = lift_at({1, 0}), c = lift_at({1, 1});
    Vec3 along_u = b - a, along_v = c - b;
    if (piece.is_square) {  // four corners need not lie in a plane: means of opposite sides
        const Vec3 d = lift_at({0, 1});
        along_u = 0.5 * (along_u + c - d);
        along_v = 0.5 * (along_v + d - a);
    }
    // No more of the tilt than keeps all corners above the triangle.
    const auto rise = [&](const Vec2& uv) {
        return glm::dot((uv.x - middle.x) * along_u + (uv.y - middle.y) * along_v, round.geometric_normal);
    };
    double lowest = std::min({rise({0, 0}), rise({1, 0}), rise({1, 1})});
    if (piece.is_square) lowest = std::min(lowest, rise({0, 1}));
    const double kept = height + lowest < 0 ? height / -lowest : 1;
    const TexelSurface::Affine& flat = piece.position;
    return TexelSurface::Affine{flat.origin + at_middle - kept * (middle.x * along_u + middle.y * along_v),
                                flat.edge_u + kept * along_u, flat.edge_v + kept * along_v};
}

}  // namespace surimi
