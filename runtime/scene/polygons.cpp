// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/polygons.h"

#include "runtime/scene/gltf_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace surimi {
namespace {

// Relative to the size of the thing. Files hold float: at 16 times its size from the origin, a monitor's
// corners are off by 16 * 6e-8 = 1e-6 of it.
constexpr double same_point = 1e-6;  ///< closer points are one; a corner closer to a straight edge is on it
// Ten times that for what depends on several corners. A panel bent by 1e-5 of its size changes no irradiance
// digit that a map can show.
constexpr double same_plane = 1e-5;
constexpr double same_area = 1e-5;  ///< relative; the corners' errors, times the perimeter

Vec3 sum_of_normals(const std::vector<Triangle>& triangles) {
    Vec3 sum(0);
    for (const Triangle& t : triangles) sum += area_normal(t[0], t[1], t[2]);
    return sum;
}

double sum_of_areas(const std::vector<Triangle>& triangles) {
    double sum = 0;
    for (const Triangle& t : triangles) sum += 0.5 * glm::length(area_normal(t[0], t[1], t[2]));
    return sum;
}

/// Diagonal of the bounds.
double size_of(const std::vector<Triangle>& triangles) {
    Vec3 low{INFINITY};
    Vec3 high{-INFINITY};
    for (const Triangle& t : triangles)
        for (const Vec3& p : t) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    return glm::length(high - low);
}

double cross(const Vec2& o, const Vec2& a, const Vec2& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Indices of the convex hull's corners, counter-clockwise (Andrew's monotone chain).
std::vector<size_t> convex_hull(const std::vector<Vec2>& points) {
    std::vector<size_t> order(points.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto is_before = [&](size_t a, size_t b) {
        return std::tuple(points[a].x, points[a].y, a) < std::tuple(points[b].x, points[b].y, b);
    };
    std::sort(order.begin(), order.end(), is_before);
    std::vector<size_t> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const size_t start = hull.size();
        for (const size_t i : order) {
            while (hull.size() >= start + 2 &&
                   cross(points[hull[hull.size() - 2]], points[hull.back()], points[i]) <= 0)
                hull.pop_back();
            hull.push_back(i);
        }
        hull.pop_back();  // the first of the next pass
        std::reverse(order.begin(), order.end());
    }
    return hull;
}

/// Drops corners that lie on the line through their neighbours, or on a neighbour, up to `tolerance`.
void drop_straight_corners(std::vector<size_t>& hull, const std::vector<Vec2>& points, double tolerance) {
    for (size_t i = 0; i < hull.size() && hull.size() > 3;) {
        const Vec2& before = points[hull[(i + hull.size() - 1) % hull.size()]];
        const Vec2& here = points[hull[i]];
        const Vec2& after = points[hull[(i + 1) % hull.size()]];
        const double length = glm::length(after - before);
        const bool is_straight = std::abs(cross(before, here, after)) <= tolerance * length;
        if (is_straight || glm::length(here - before) <= tolerance) {
            hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
            i = i > 0 ? i - 1 : 0;  // the neighbour's angle has changed
        } else {
            ++i;
        }
    }
}

/// Numbers for positions: the same for those closer than `tolerance`.
class PointNumbers {
  public:
    explicit PointNumbers(double tolerance) : tolerance_(tolerance) {}

    size_t number_of(const Vec3& p) {
        const std::array<int64_t, 3> cell{cell_of(p.x), cell_of(p.y), cell_of(p.z)};
        for (int64_t i = 0; i < 27; ++i) {  // the cell and its neighbours
            const auto found = cells_.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
            if (found != cells_.end() && glm::length(found->second.first - p) <= tolerance_)
                return found->second.second;
        }
        const size_t number = cells_.size();
        cells_.emplace(cell, std::pair(p, number));
        return cells_[cell].second;
    }

  private:
    int64_t cell_of(double x) const {
        return static_cast<int64_t>(std::floor(std::clamp(x / tolerance_, -9e15, 9e15)));
    }

    double tolerance_;
    std::map<std::array<int64_t, 3>, std::pair<Vec3, size_t>> cells_;
};

/// Is `t` in the plane through `seed`, facing the same side?
bool is_in_plane_of(const Triangle& seed, const Triangle& t, double tolerance) {
    const Vec3 normal = normalize_or(area_normal(seed[0], seed[1], seed[2]), Vec3(0));
    if (glm::dot(normal, area_normal(t[0], t[1], t[2])) <= 0) return false;
    return std::all_of(t.begin(), t.end(),
                       [&](const Vec3& p) { return std::abs(glm::dot(normal, p - seed[0])) <= tolerance; });
}

/// Finds the connected flat parts of a set of triangles.
class FlatParts {
  public:
    explicit FlatParts(const std::vector<Triangle>& triangles)
        : triangles_(triangles),
          size_(size_of(triangles)),
          corners_(triangles.size()),
          is_taken_(triangles.size(), false) {
        PointNumbers numbers(same_point * size_);
        for (size_t t = 0; t < triangles.size(); ++t) {
            for (size_t k = 0; k < 3; ++k) corners_[t][k] = numbers.number_of(triangles[t][k]);
            for (size_t k = 0; k < 3; ++k) at_edge_.emplace(std::pair(corners_[t][k], corners_[t][(k + 1) % 3]), t);
        }
    }

    /// Parts as indices of triangles, grown from the largest triangle on, so that the plane they are held
    /// against is the best known one and cannot drift.
    std::vector<std::vector<size_t>> find() {
        std::vector<size_t> order(triangles_.size());
        std::iota(order.begin(), order.end(), size_t{0});
        const auto doubled_area = [&](size_t t) {
            return glm::length(area_normal(triangles_[t][0], triangles_[t][1], triangles_[t][2]));
        };
        std::stable_sort(order.begin(), order.end(),
                         [&](size_t a, size_t b) { return doubled_area(a) > doubled_area(b); });
        std::vector<std::vector<size_t>> parts;
        for (const size_t seed : order)
            if (!is_taken_[seed]) parts.push_back(grow(seed));
        return parts;
    }

  private:
    std::vector<size_t> grow(size_t seed) {
        is_taken_[seed] = true;
        std::vector<size_t> part{seed};
        for (size_t i = 0; i < part.size(); ++i)
            for (size_t k = 0; k < 3; ++k)
                take_across(seed, {corners_[part[i]][(k + 1) % 3], corners_[part[i]][k]}, part);
        return part;
    }

    void take_across(size_t seed, const std::pair<size_t, size_t>& edge, std::vector<size_t>& part) {
        const auto [first, last] = at_edge_.equal_range(edge);
        for (auto it = first; it != last; ++it) {
            const size_t t = it->second;
            if (is_taken_[t] || !is_in_plane_of(triangles_[seed], triangles_[t], same_plane * size_)) continue;
            is_taken_[t] = true;
            part.push_back(t);
        }
    }

    const std::vector<Triangle>& triangles_;
    double size_;
    std::vector<std::array<size_t, 3>> corners_;  ///< numbers of their positions
    std::vector<bool> is_taken_;
    std::multimap<std::pair<size_t, size_t>, size_t> at_edge_;  ///< triangles by directed edge
};

}  // namespace

bool is_planar(const std::vector<Triangle>& triangles) {
    if (triangles.empty()) return false;
    const Vec3 normal = normalize_or(sum_of_normals(triangles), Vec3(0));
    const double tolerance = same_plane * size_of(triangles);
    for (const Triangle& t : triangles) {
        if (glm::dot(normal, area_normal(t[0], t[1], t[2])) <= 0) return false;
        for (const Vec3& p : t)
            if (!(std::abs(glm::dot(normal, p - triangles[0][0])) <= tolerance)) return false;
    }
    return true;
}

std::optional<Polygon> one_polygon(const std::vector<Triangle>& triangles) {
    if (!is_planar(triangles)) return std::nullopt;
    const Vec3 normal = normalize_or(sum_of_normals(triangles), Vec3(0));
    const Vec3 helper = std::abs(normal.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);  // any that is not parallel
    const Vec3 u = normalize_or(glm::cross(helper, normal), Vec3(0));
    const Vec3 v = glm::cross(normal, u);
    std::vector<Vec3> positions;
    std::vector<Vec2> points;
    for (const Triangle& t : triangles)
        for (const Vec3& p : t) {
            positions.push_back(p);
            points.emplace_back(glm::dot(p - triangles[0][0], u), glm::dot(p - triangles[0][0], v));
        }
    std::vector<size_t> hull = convex_hull(points);
    drop_straight_corners(hull, points, same_point * size_of(triangles));
    if (hull.size() < 3) return std::nullopt;
    Polygon polygon;
    for (const size_t i : hull) polygon.corners.push_back(positions[i]);
    const double expected = sum_of_areas(triangles);
    if (!(std::abs(area(polygon) - expected) <= same_area * expected)) return std::nullopt;
    return polygon;
}

std::vector<Polygon> make_polygons(const std::vector<Triangle>& source) {
    std::vector<Triangle> triangles;
    std::copy_if(source.begin(), source.end(), std::back_inserter(triangles),
                 [](const Triangle& t) { return !is_degenerate(t[0], t[1], t[2]); });
    if (triangles.empty()) return {};
    if (std::optional<Polygon> polygon = one_polygon(triangles)) return {std::move(*polygon)};
    std::vector<Polygon> polygons;
    for (const std::vector<size_t>& part : FlatParts(triangles).find()) {
        std::vector<Triangle> members;
        for (const size_t t : part) members.push_back(triangles[t]);
        if (std::optional<Polygon> polygon = one_polygon(members)) {
            polygons.push_back(std::move(*polygon));
            continue;
        }
        for (const Triangle& t : members) polygons.push_back({{t[0], t[1], t[2]}});
    }
    return polygons;
}

bool is_rectangle(const Polygon& polygon) {
    if (polygon.corners.size() != 4) return false;
    for (size_t i = 0; i < 4; ++i) {
        const Vec3 in = polygon.corners[(i + 1) % 4] - polygon.corners[i];
        const Vec3 out = polygon.corners[(i + 3) % 4] - polygon.corners[i];
        if (std::abs(glm::dot(in, out)) > 0.01 * glm::length(in) * glm::length(out)) return false;
    }
    return true;
}

}  // namespace surimi
