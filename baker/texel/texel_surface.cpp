// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/texel_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "baker/texel/polygon.h"

namespace surimi {
namespace {

using Corners = std::array<Vec2, 3>;

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Triangle clipped by the unit square at `corner` (Sutherland and Hodgman 1974); empty when only touched.
std::vector<Vec2> clip_to_square(const Corners& triangle, const Vec2& corner) {
    std::vector<Vec2> polygon(triangle.begin(), triangle.end()), clipped;
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const double sign = side % 2 ? -1 : 1, bound = corner[axis] + side % 2;
        clipped.clear();
        for (size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
            if (da >= 0) clipped.push_back(a);
            if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
                Vec2 crossing = a + (b - a) * (da / (da - db));
                crossing[axis] = bound;
                clipped.push_back(crossing);
            }
        }
        polygon.swap(clipped);
    }
    return polygon;
}

/// Barycentric weights of a point in the plane of a uv triangle; the caller takes care of degenerate ones.
Vec3 barycentric_weights(const Corners& t, const Vec2& p, double doubled_area) {
    return Vec3(twice_area(p, t[1], t[2]), twice_area(t[0], p, t[2]), twice_area(t[0], t[1], p)) / doubled_area;
}

/// The weights moved onto the triangle. They sum to 1, so one of them is at least 1/3 and the sum is not 0.
Vec3 clamped(const Vec3& weights) {
    const Vec3 positive = glm::max(weights, Vec3(0));
    return positive / (positive.x + positive.y + positive.z);
}

}  // namespace

TexelSurface::TexelSurface(const Scene& scene, const Atlas& atlas, const Texels& texels, const Texel& texel)
    : scene_(scene), atlas_(atlas) {
    const auto width = static_cast<uint32_t>(texels.width);
    const Vec2 corner(texel.index % width, texel.index / width);
    for (const TriangleRef& triangle : texels.triangles_of(texel)) add(triangle, corner);
    area_ = total_;
    if (total_ > 0) return;
    // Nothing but touches: every triangle stands in with the point nearest to the texel, all of equal weight.
    for (const TriangleRef& triangle : texels.triangles_of(texel)) {
        const Corners t = texel_corners(atlas, triangle);
        const double doubled = twice_area(t[0], t[1], t[2]);
        const Vec3 nearest = doubled != 0 ? clamped(barycentric_weights(t, corner + 0.5, doubled)) : Vec3(1.0 / 3);
        add_piece(triangle, 1, true, {nearest, Vec3(0), Vec3(0)});
    }
}

void TexelSurface::add_piece(const TriangleRef& triangle, double area, bool is_square, const Affine& barycentric) {
    const Surface& surface = scene_.surfaces[triangle.surface];
    const auto& [i, j, k] = surface.triangles[triangle.triangle];
    const auto interpolated = [&](const std::vector<Vec3>& values) {
        const Mat3 corners(values[i], values[j], values[k]);
        return Affine{corners * barycentric.origin, corners * barycentric.edge_u, corners * barycentric.edge_v};
    };
    total_ += area;
    Piece& piece = pieces_.emplace_back();
    piece.cumulative = total_;
    piece.is_square = is_square;
    piece.triangle = triangle;
    piece.geometric_normal =
        normalize_or(area_normal(surface.positions[i], surface.positions[j], surface.positions[k]), surface.normals[i]);
    piece.barycentric = barycentric;
    piece.position = interpolated(surface.positions);
    const Vec3 &a = surface.normals[i], &b = surface.normals[j], &c = surface.normals[k];
    piece.has_one_normal = a == b && b == c;
    piece.normal = piece.has_one_normal ? Affine{normalize_or(a, piece.geometric_normal), Vec3(0), Vec3(0)}
                                        : interpolated(surface.normals);
}

void TexelSurface::add(const TriangleRef& triangle, const Vec2& corner) {
    const Corners t = texel_corners(atlas_, triangle);
    const double doubled = twice_area(t[0], t[1], t[2]);
    const std::vector<Vec2> polygon = clip_to_square(t, corner);
    if (doubled == 0 || polygon.size() < 3) return;
    const Surface& surface = scene_.surfaces[triangle.surface];
    const auto& [i, j, k] = surface.triangles[triangle.triangle];
    const double metres2_per_texel2 =
        glm::length(area_normal(surface.positions[i], surface.positions[j], surface.positions[k])) / std::abs(doubled);

    const auto weights = [&](const Vec2& p) { return clamped(barycentric_weights(t, p, doubled)); };
    double polygon_area = 0;
    for (size_t c = 1; c + 1 < polygon.size(); ++c)
        polygon_area += 0.5 * std::abs(twice_area(polygon[0], polygon[c], polygon[c + 1]));
    if (polygon_area > 1 - 1e-12) {  // the whole texel: one square keeps the samples' stratification
        const Vec3 origin = weights(corner);
        add_piece(triangle, metres2_per_texel2, true,
                  {origin, weights(corner + Vec2(1, 0)) - origin, weights(corner + Vec2(0, 1)) - origin});
        return;
    }
    for (size_t c = 1; c + 1 < polygon.size(); ++c) {
        const double area = 0.5 * std::abs(twice_area(polygon[0], polygon[c], polygon[c + 1])) * metres2_per_texel2;
        if (!(area > 0)) continue;
        const Vec3 origin = weights(polygon[0]), second = weights(polygon[c]);
        add_piece(triangle, area, false, {origin, second - origin, weights(polygon[c + 1]) - second});
    }
}

const TexelSurface::Piece& TexelSurface::choose(double& u, double& v) const {
    const Piece* piece = &pieces_.front();
    if (pieces_.size() > 1) {
        const double target = u * total_;
        double before = 0;
        while (piece != &pieces_.back() && !(target < piece->cumulative)) before = (piece++)->cumulative;
        // The number that chose the piece is stretched to serve again within it: strata survive.
        u = std::clamp((target - before) / (piece->cumulative - before), 0.0, 1.0);
    }
    if (!piece->is_square) {
        u = std::sqrt(u);  // edge_u runs to the second corner, edge_v from there to the third
        v *= u;
    }
    return *piece;
}

SurfacePoint TexelSurface::sample(double u, double v) const {
    const Piece& piece = choose(u, v);
    return point_of(piece, {u, v});
}

SurfacePoint TexelSurface::point_of(const Piece& piece, const Vec2& uv) {
    const Vec3 normal = piece.unit_normal(uv.x, uv.y);
    return {piece.triangle, piece.barycentric.at(uv.x, uv.y), piece.position.at(uv.x, uv.y), normal,
            piece.is_lifted ? normal : piece.geometric_normal};
}

double TexelSurface::share_of(const Piece& piece) const {
    const double before = &piece == &pieces_.front() ? 0 : (&piece - 1)->cumulative;
    return (piece.cumulative - before) / total_;
}

SurfacePoint TexelSurface::center() const {
    const auto middle_of = [](const Piece& piece) { return point_of(piece, piece.middle()); };
    if (pieces_.size() == 1) return middle_of(pieces_.front());
    Vec3 position(0), normal(0);
    for (const Piece& piece : pieces_) {
        const double share = share_of(piece);
        const SurfacePoint middle = middle_of(piece);
        position += share * middle.position;
        normal += share * middle.normal;
    }
    SurfacePoint best = middle_of(pieces_.front());
    bool is_flat = true, is_lifted = false;
    for (const Piece& piece : pieces_) {
        const SurfacePoint middle = middle_of(piece);
        if (glm::length(middle.position - position) < glm::length(best.position - position)) best = middle;
        // One plane to the rounding of float vertices.
        is_flat = is_flat && glm::dot(piece.geometric_normal, pieces_.front().geometric_normal) > 1 - 1e-10;
        is_lifted = is_lifted || piece.is_lifted;
    }
    if (!is_flat) return best;
    best.position = position;
    best.normal = normalize_or(normal, best.geometric_normal);
    if (is_lifted) best.geometric_normal = best.normal;
    return best;
}

Vec3 TexelSurface::Piece::plane_normal() const {
    if (!is_lifted) return geometric_normal;
    const Vec3 across = normalize_or(glm::cross(position.edge_u, position.edge_v), geometric_normal);
    return glm::dot(across, geometric_normal) < 0 ? -across : across;
}

void TexelSurface::lift(size_t piece, const Affine& position) {
    pieces_[piece].position = position;
    pieces_[piece].is_lifted = true;
}

namespace {

using Polygon2 = std::vector<Vec2>;

Polygon2 outline_of(const TexelSurface::Piece& piece) {
    if (piece.is_square) return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return {{0, 0}, {1, 0}, {1, 1}};
}

/// The ends of a crossing in the piece's own coordinates; nothing for a piece without area.
std::optional<std::array<Vec2, 2>> local_ends(const TexelSurface::Piece& piece,
                                              const TexelSurface::Crossing& crossing) {
    const Vec3 &u = piece.position.edge_u, &v = piece.position.edge_v;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv)) return std::nullopt;
    const auto local = [&](const Vec3& place) {
        const Vec3 d = place - piece.position.origin;
        const double du = glm::dot(d, u), dv = glm::dot(d, v);
        return Vec2(du * vv - dv * uv, dv * uu - du * uv) / determinant;
    };
    return std::array{local(crossing.from), local(crossing.to)};
}

/// Does some of the segment from a to b lie within the convex counter-clockwise polygon?
bool crosses(const Polygon2& polygon, const Vec2& a, const Vec2& b) {
    double begin = 0, end = 1;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &p = polygon[i], side = polygon[(i + 1) % polygon.size()] - p;
        const auto height = [&](const Vec2& q) { return side.x * (q.y - p.y) - side.y * (q.x - p.x); };
        const double from = height(a), to = height(b);
        if (from <= 0 && to <= 0) return false;
        if (from < 0) begin = std::max(begin, from / (from - to));
        if (to < 0) end = std::min(end, from / (from - to));
    }
    return begin < end;
}

/// Every polygon that the segment crosses is cut along its line, unless a part would be smaller than `least`.
void cut_polygons(std::vector<Polygon2>& polygons, const Vec2& a, const Vec2& b, double least) {
    const Vec2 normal(a.y - b.y, b.x - a.x);
    const Vec3 line(normal, -glm::dot(normal, a));
    const size_t count = polygons.size();
    for (size_t i = 0; i < count; ++i) {
        if (!crosses(polygons[i], a, b)) continue;
        Polygon2 left, right;
        cut(polygons[i], line, left);
        cut(polygons[i], -line, right);
        if (area_of(left) < least || area_of(right) < least) continue;
        polygons[i] = std::move(left);
        polygons.push_back(std::move(right));
    }
}

/// Is the quadrilateral a parallelogram, to what cutting rounds?
bool is_parallelogram(const Polygon2& p) {
    return p.size() == 4 && glm::length(p[0] + p[2] - p[1] - p[3]) < 1e-12;
}

}  // namespace

/// The part of `whole` with these corners in its coordinates: a triangle, or a parallelogram by three of its corners.
void TexelSurface::add_part(const Piece& whole, double area, bool is_square, const std::array<Vec2, 3>& corners) {
    const auto part_of = [&](const Affine& value) {
        const auto at = [&](const Vec2& uv) { return value.at(uv.x, uv.y); };
        const Vec3 origin = at(corners[0]), second = at(corners[1]);
        return Affine{origin, second - origin, at(corners[2]) - second};
    };
    total_ += area;
    Piece& piece = pieces_.emplace_back(whole);
    piece.cumulative = total_;
    piece.is_square = is_square;
    piece.barycentric = part_of(whole.barycentric);
    piece.position = part_of(whole.position);
    if (!whole.has_one_normal) piece.normal = part_of(whole.normal);
}

TexelSurface::CutResult TexelSurface::cut(std::span<const Crossing> crossings, double least, size_t most) {
    if (crossings.empty() || !(area_ > 0)) return {};
    std::vector<std::vector<Polygon2>> parts;
    size_t count = 0;
    bool is_cut = false;
    for (size_t i = 0; i < pieces_.size(); ++i) {
        const Piece& piece = pieces_[i];
        std::vector<Polygon2>& polygons = parts.emplace_back(1, outline_of(piece));
        const double least_part = least * area_of(polygons[0]) / share_of(piece);
        for (const Crossing& crossing : crossings) {
            if (crossing.piece != i) continue;
            if (const auto ends = local_ends(piece, crossing))
                cut_polygons(polygons, (*ends)[0], (*ends)[1], least_part);
            if (polygons.size() > most) return {true, false};
        }
        for (const Polygon2& polygon : polygons) count += is_parallelogram(polygon) ? 1 : polygon.size() - 2;
        is_cut = is_cut || polygons.size() > 1;
        if (count > most && is_cut) return {true, false};
    }
    if (!is_cut) return {};
    const std::vector<Piece> wholes = std::exchange(pieces_, {});
    total_ = 0;
    for (size_t i = 0; i < wholes.size(); ++i) {
        const double before = i == 0 ? 0 : wholes[i - 1].cumulative;
        const double scale = (wholes[i].cumulative - before) / area_of(outline_of(wholes[i]));
        for (const Polygon2& p : parts[i]) {
            if (is_parallelogram(p)) {
                add_part(wholes[i], scale * area_of(p), true, {p[0], p[1], p[2]});
                continue;
            }
            for (size_t c = 1; c + 1 < p.size(); ++c) {
                const std::array<Vec2, 3> triangle = {p[0], p[c], p[c + 1]};
                add_part(wholes[i], scale * area_of(triangle), false, triangle);
            }
        }
    }
    return {true, true};
}

void TexelSurface::keep(uint32_t pieces) {
    const std::vector<Piece> all = std::exchange(pieces_, {});
    total_ = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        if ((pieces >> i & 1u) == 0) continue;
        total_ += all[i].cumulative - (i == 0 ? 0 : all[i - 1].cumulative);
        pieces_.push_back(all[i]);
        pieces_.back().cumulative = total_;
    }
    if (area_ > 0) area_ = total_;
}

void TexelSurface::turn_over() {
    for (Piece& piece : pieces_) {
        piece.geometric_normal = -piece.geometric_normal;
        piece.normal = {-piece.normal.origin, -piece.normal.edge_u, -piece.normal.edge_v};
    }
}

}  // namespace surimi
