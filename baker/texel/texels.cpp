// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

using Corners = std::array<Vec2, 3>;

Corners texel_corners(const Atlas& atlas, const TriangleRef& ref) {
    Corners corners;
    const auto& uv = atlas.surfaces[ref.surface].uv[ref.triangle];
    for (size_t i = 0; i < 3; ++i) corners[i] = Vec2(uv[i]) * Vec2(atlas.width, atlas.height);
    return corners;
}

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Do the closed triangle and the open unit square at (x, y) meet? By separating axes: the square's two, the edges'
/// three.
bool meets_square(const Corners& t, int x, int y) {
    const Vec2 center(x + 0.5, y + 0.5);
    for (int axis = 0; axis < 2; ++axis) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (low >= center[axis] + 0.5 || high <= center[axis] - 0.5) return false;
    }
    for (size_t e = 0; e < 3; ++e) {
        const Vec2 edge = t[(e + 1) % 3] - t[e];
        const Vec2 normal(-edge.y, edge.x);
        const double reach = 0.5 * (std::abs(normal.x) + std::abs(normal.y));
        const double d0 = glm::dot(normal, t[e] - center), d1 = glm::dot(normal, t[(e + 2) % 3] - center);
        if (std::min(d0, d1) >= reach || std::max(d0, d1) <= -reach) return false;
    }
    return true;
}

struct Touch {
    uint32_t texel = 0;
    uint32_t chart = 0;
    TriangleRef triangle;
    auto key() const { return std::tie(texel, chart, triangle.surface, triangle.triangle); }
};

void add_touches(const Atlas& atlas, const TriangleRef& ref, std::vector<Touch>& touches) {
    const Corners t = texel_corners(atlas, ref);
    const uint32_t chart = atlas.surfaces[ref.surface].chart[ref.triangle];
    const auto range = [&](int axis, int size) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        return std::pair{std::clamp(static_cast<int>(std::floor(low)), 0, size - 1),
                         std::clamp(static_cast<int>(std::floor(high)), 0, size - 1)};
    };
    const auto [x0, x1] = range(0, atlas.width);
    const auto [y0, y1] = range(1, atlas.height);
    const size_t before = touches.size();
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
            if (meets_square(t, x, y)) touches.push_back({static_cast<uint32_t>(y * atlas.width + x), chart, ref});
    if (touches.size() > before) return;
    // Flat along a texel border: it meets no open square, so the squares of its box stand in.
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) touches.push_back({static_cast<uint32_t>(y * atlas.width + x), chart, ref});
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

Texels find_texels(const Scene& scene, const Atlas& atlas, int page) {
    std::vector<std::vector<Touch>> by_surface(scene.surfaces.size());
    parallel_for(scene.surfaces.size(), 1, [&](size_t s) {
        if (atlas.surfaces[s].page != page) return;
        for (uint32_t t = 0; t < scene.surfaces[s].triangles.size(); ++t)
            add_touches(atlas, {static_cast<uint32_t>(s), t}, by_surface[s]);
    });
    std::vector<Touch> touches;
    for (const auto& some : by_surface) touches.insert(touches.end(), some.begin(), some.end());
    std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) { return a.key() < b.key(); });

    Texels result;
    result.page = page;
    result.width = atlas.width;
    result.height = atlas.height;
    for (const Touch& touch : touches) {
        const bool is_new = result.texels.empty() || result.texels.back().index != touch.texel;
        if (is_new)
            result.texels.push_back({touch.texel, touch.chart, static_cast<uint32_t>(result.triangles.size()), 0});
        if (touch.chart != result.texels.back().chart) continue;
        ++result.texels.back().count;
        result.triangles.push_back(touch.triangle);
    }
    return result;
}

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
    return {piece.triangle, piece.barycentric.at(uv.x, uv.y), piece.position.at(uv.x, uv.y),
            piece.unit_normal(uv.x, uv.y), piece.geometric_normal};
}

double TexelSurface::share_of(const Piece& piece) const {
    const double before = &piece == &pieces_.front() ? 0 : (&piece - 1)->cumulative;
    return (piece.cumulative - before) / total_;
}

SurfacePoint TexelSurface::center() const {
    const auto middle_of = [](const Piece& piece) {
        return point_of(piece, piece.is_square ? Vec2(0.5) : Vec2(2.0 / 3, 1.0 / 3));
    };
    if (pieces_.size() == 1) return middle_of(pieces_.front());
    Vec3 position(0), normal(0);
    for (const Piece& piece : pieces_) {
        const double share = share_of(piece);
        const SurfacePoint middle = middle_of(piece);
        position += share * middle.position;
        normal += share * middle.normal;
    }
    SurfacePoint best = middle_of(pieces_.front());
    bool is_flat = true;
    for (const Piece& piece : pieces_) {
        const SurfacePoint middle = middle_of(piece);
        if (glm::length(middle.position - position) < glm::length(best.position - position)) best = middle;
        // One plane to the rounding of float vertices.
        is_flat = is_flat && glm::dot(piece.geometric_normal, pieces_.front().geometric_normal) > 1 - 1e-10;
    }
    if (!is_flat) return best;
    best.position = position;
    best.normal = normalize_or(normal, best.geometric_normal);
    return best;
}

}  // namespace surimi
