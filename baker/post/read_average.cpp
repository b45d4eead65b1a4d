// SPDX-License-Identifier: Apache-2.0
#include "baker/post/read_average.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "baker/texel/polygon.h"

namespace surimi {
namespace {

constexpr double least_whole = 0.999;  // of a square: weights differ by less than the rest, which is not measured

struct Place {
    int x = 0, y = 0;
};

Place place_of(const Texels& texels, const Texel& texel) {
    const auto width = static_cast<uint32_t>(texels.width);
    return {static_cast<int>(texel.index % width), static_cast<int>(texel.index / width)};
}

/// Calls visit(polygon) for convex polygons on the map, in texels, that are what was measured of a texel: maybe with
/// more beyond its square.
template <class Visit>
void for_each_polygon(const Receivers& receivers, std::span<const Panel> panels, const Texel& texel,
                      const Visit& visit) {
    if (texel.free_pieces == Texel::all_pieces) {
        for (const TriangleRef& triangle : receivers.texels.triangles_of(texel))
            visit(texel_corners(receivers.atlas, triangle));
        return;
    }
    const TexelSurface surface = exposed_surface(receivers, texel, panels);
    for (const TexelSurface::Piece& piece : surface.pieces()) {
        const auto corners = texel_corners(receivers.atlas, piece.triangle);
        const auto at = [&](double u, double v) {
            const Vec3 weights = piece.barycentric.at(u, v);
            return weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
        };
        visit(std::array{at(0, 0), at(1, 0), at(1, 1)});
        if (piece.is_square) visit(std::array{at(0, 0), at(1, 1), at(0, 1)});
    }
}

/// Cuts polygons, in arrays that are used again.
class Cutter {
  public:
    /// The part over a texel's square, relative to its centre: in [-1/2, 1/2]^2.
    std::span<const Vec2> over_texel(std::span<const Vec2> polygon, const Place& place) {
        const Vec2 center(place.x + 0.5, place.y + 0.5);
        part_.clear();
        for (const Vec2& corner : polygon) part_.push_back(corner - center);
        for (const Vec3& line : {Vec3(1, 0, 0.5), Vec3(-1, 0, 0.5), Vec3(0, 1, 0.5), Vec3(0, -1, 0.5)}) keep(line);
        return part_;
    }
    /// The part of a polygon in one quarter, mirrored into the one where both coordinates are positive.
    std::span<const Vec2> in_quarter(std::span<const Vec2> polygon, const Vec2& signs) {
        part_.assign(polygon.begin(), polygon.end());
        for (Vec2& corner : part_) corner *= signs;
        for (const Vec3& line : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) keep(line);
        return part_;
    }

  private:
    void keep(const Vec3& line) {
        cut(part_, line, rest_);
        std::swap(part_, rest_);
    }
    std::vector<Vec2> part_, rest_;
};

/// Integrals over a polygon, whatever its orientation.
struct Moments {
    double one = 0, x = 0, y = 0, xy = 0;
};

Moments moments_of(std::span<const Vec2> polygon) {
    Moments sum;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Vec2 &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
        const double area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        const Vec2 corners = a + b + c;
        sum.one += area;
        sum.x += area / 3 * corners.x;
        sum.y += area / 3 * corners.y;
        sum.xy += area / 12 * (corners.x * corners.y + a.x * a.y + b.x * b.y + c.x * c.y);
    }
    if (sum.one < 0) sum = {-sum.one, -sum.x, -sum.y, -sum.xy};
    return sum;
}

/// Integrals of the bilinear weights of the 3 x 3 texels, row by row.
using Weights = std::array<double, 9>;

void add_quarter(const Moments& moments, int side_x, int side_y, Weights& weights) {
    const auto at = [&](int x, int y) -> double& { return weights[static_cast<size_t>((y + 1) * 3 + x + 1)]; };
    at(0, 0) += moments.one - moments.x - moments.y + moments.xy;
    at(side_x, 0) += moments.x - moments.xy;
    at(0, side_y) += moments.y - moments.xy;
    at(side_x, side_y) += moments.xy;
}

/// Gives what lies outside the map to its border.
void clamp_to_map(const Place& place, const Texels& texels, Weights& weights) {
    const auto move = [&](size_t from, size_t to) {
        weights[to] += weights[from];
        weights[from] = 0;
    };
    for (size_t i = 0; i < 3; ++i) {
        if (place.x == 0) move(3 * i, 3 * i + 1);
        if (place.x == texels.width - 1) move(3 * i + 2, 3 * i + 1);
    }
    for (size_t i = 0; i < 3; ++i) {
        if (place.y == 0) move(i, 3 + i);
        if (place.y == texels.height - 1) move(6 + i, 3 + i);
    }
}

}  // namespace

bool is_read_as_whole(const Receivers& receivers, const Texel& texel) {
    const Texels& texels = receivers.texels;
    const Place place = place_of(texels, texel);
    if (texel.free_pieces != Texel::all_pieces) return false;
    if (place.x == 0 || place.y == 0 || place.x == texels.width - 1 || place.y == texels.height - 1) return false;
    Cutter cutter;
    double area = 0;
    for (const TriangleRef& triangle : texels.triangles_of(texel))
        area += std::abs(area_of(cutter.over_texel(texel_corners(receivers.atlas, triangle), place)));
    return area >= least_whole;
}

ReadAverage read_average(const Receivers& receivers, std::span<const Panel> panels, const Texel& texel) {
    const Place place = place_of(receivers.texels, texel);
    Cutter squares, quarters;
    Weights weights{};
    double area = 0;
    for_each_polygon(receivers, panels, texel, [&](const std::array<Vec2, 3>& triangle) {
        const std::span<const Vec2> part = squares.over_texel(triangle, place);
        area += std::abs(area_of(part));
        for (const int y : {-1, 1})
            for (const int x : {-1, 1}) add_quarter(moments_of(quarters.in_quarter(part, Vec2(x, y))), x, y, weights);
    });
    clamp_to_map(place, receivers.texels, weights);
    ReadAverage average;
    constexpr double least_area = 1e-9;  // what is less is rounding of a triangle that only touches
    if (!(area > least_area)) return average;
    double sum = 0;
    for (double& weight : weights) sum += weight = std::max(0.0, weight);
    for (size_t i = 0; i < weights.size(); ++i) average.weights[i] = static_cast<float>(weights[i] / sum);
    average.area = static_cast<float>(std::min(1.0, area));
    return average;
}

}  // namespace surimi
