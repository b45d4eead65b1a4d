// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/round_chart.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

/// coordinate_slack counts on it.
constexpr double most_steps = 8;
constexpr int most_passes = 6;
/// A triangle counts as collapsed when its area is below this share of its longest edge squared, in texels,
/// ...
constexpr double collapsed_share = 2e-9;
/// ... or it is lower than this, in steps: then a reader that rounds once more (text with nine digits) may
/// flip it.
constexpr double least_height = 0.25;

class Repair {
  public:
    Repair(const std::vector<std::array<uint32_t, 3>>& triangles, std::vector<Vec2>& points, const MapSize& map)
        : triangles_(triangles), points_(points), start_(points), texels_(map.width * uv_step, map.height * uv_step) {}

    FlatTriangle triangle(uint32_t t) const {
        const auto& c = triangles_[t];
        return {points_[c[0]], points_[c[1]], points_[c[2]]};
    }

    bool is_bad(uint32_t t) const {
        const FlatTriangle flat = triangle(t);
        const double doubled = doubled_area(flat);
        if (!(doubled > least_height * std::sqrt(longest_edge_squared(flat)))) return true;
        const double longest = longest_edge_squared({flat[0] * texels_, flat[1] * texels_, flat[2] * texels_});
        return 0.5 * doubled * texels_.x * texels_.y <= collapsed_share * longest;
    }

    std::vector<uint32_t> find_bad() const {
        std::vector<uint32_t> bad;
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            if (is_bad(t)) bad.push_back(t);
        return bad;
    }

    /// Lifts a corner of a bad triangle above the opposite edge.
    void lift(uint32_t t) {
        std::array<uint32_t, 3> order{0, 1, 2};  // corners, the one opposite the longest edge first
        const FlatTriangle flat = triangle(t);
        const auto opposite = [&](uint32_t k) {
            const Vec2 edge = flat[(k + 2) % 3] - flat[(k + 1) % 3];
            return glm::dot(edge, edge);
        };
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            return opposite(a) != opposite(b) ? opposite(a) > opposite(b) : a < b;
        });
        for (const uint32_t k : order) {
            const Vec2& a = flat[(k + 1) % 3];
            const Vec2& b = flat[(k + 2) % 3];
            const double length = glm::length(b - a);
            if (length == 0) continue;
            const Vec2 inwards = Vec2(a.y - b.y, b.x - a.x) / length;
            const double height = doubled_area(flat) / length;
            for (const double target : {0.8, 1.5, 2.5, 4.0})
                if (move(triangles_[t][k], flat[k] + inwards * (target - height))) return;
        }
    }

    /// Pushes the corners of `other` that lie just inside an edge of `t` back over it.
    bool push_out(uint32_t t, uint32_t other) {
        const FlatTriangle flat = triangle(t);
        for (size_t e = 0; e < 3; ++e) {
            const Vec2& a = flat[e];
            const Vec2& b = flat[(e + 1) % 3];
            const double length = glm::length(b - a);
            const Vec2 outwards = Vec2(b.y - a.y, a.x - b.x) / length;
            double deepest = 0;
            for (const uint32_t p : triangles_[other])
                deepest = std::max(deepest, doubled_area(a, b, points_[p]) / length);
            if (deepest > most_steps) continue;
            bool is_done = true;
            for (const uint32_t p : triangles_[other]) {
                const double depth = doubled_area(a, b, points_[p]) / length;
                if (depth <= 0) continue;
                bool has_moved = false;
                for (const double extra : {0.5, 1.0, 1.5})
                    has_moved = has_moved || (move(p, points_[p] + outwards * (depth + extra)) &&
                                              doubled_area(a, b, points_[p]) <= 0);
                is_done = is_done && has_moved;
            }
            if (is_done) return true;
        }
        return false;
    }

  private:
    /// Moves a point to the nearest whole step if that is within reach and makes no triangle bad that was
    /// not, and leaves fewer of them bad or all of them good.
    bool move(uint32_t point, const Vec2& to) {
        const Vec2 target = glm::round(to);
        const Vec2 from = points_[point];
        if (target == from || glm::length(target - start_[point]) > most_steps) return false;
        const size_t before = count_bad(point);
        points_[point] = target;
        const size_t after = count_bad(point);
        if (after == 0 || after < before) return true;
        points_[point] = from;
        return false;
    }

    size_t count_bad(uint32_t point) {
        if (first_.empty()) list_triangles();
        size_t count = 0;
        for (uint32_t i = first_[point]; i < first_[point + 1]; ++i) count += is_bad(around_[i]) ? 1 : 0;
        return count;
    }

    void list_triangles() {
        first_.assign(points_.size() + 1, 0);
        for (const auto& t : triangles_)
            for (const uint32_t p : t) ++first_[p + 1];
        for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        around_.resize(first_.back());
        std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            for (const uint32_t p : triangles_[t]) around_[next[p]++] = t;
    }

    const std::vector<std::array<uint32_t, 3>>& triangles_;
    std::vector<Vec2>& points_;
    std::vector<Vec2> start_;
    Vec2 texels_;                   ///< in a step
    std::vector<uint32_t> first_;   ///< of each point, in around_
    std::vector<uint32_t> around_;  ///< triangles at the points
};

}  // namespace

RoundedChart round_chart(const FlatChart& chart, const TexelChart& shape, const Placement& placement,
                         const MapSize& map) {
    RoundedChart result;
    const Vec2 steps(1 / (uv_step * map.width), 1 / (uv_step * map.height));  // in a texel
    const Vec2 corner = glm::round(Vec2(placement.x, placement.y) * steps);
    result.points.reserve(shape.points.size());
    for (const Vec2& p : shape.points)
        result.points.push_back(corner + glm::round(turned(p, shape, placement.turns) * steps));
    if (chart.is_sliver) return result;

    // A mirrored chart runs clockwise as a whole; it is judged as if seen from behind.
    std::vector<std::array<uint32_t, 3>> triangles = chart.triangles;
    if (placement.turns >= mirrored)
        for (auto& t : triangles) std::swap(t[1], t[2]);
    Repair repair(triangles, result.points, map);
    for (int pass = 0; pass <= most_passes; ++pass) {
        result.bad = repair.find_bad();
        if (!result.bad.empty()) {
            if (pass < most_passes)
                for (const uint32_t t : result.bad)
                    if (repair.is_bad(t)) repair.lift(t);
            if (pass < most_passes) continue;
        }
        std::vector<FlatTriangle> flat;
        for (uint32_t t = 0; t < triangles.size(); ++t) flat.push_back(repair.triangle(t));
        result.overlapping = overlapping_pairs(flat, 0, 256);
        if (result.overlapping.empty()) break;
        if (pass < most_passes)
            for (const auto& [a, b] : result.overlapping)
                if (do_overlap(repair.triangle(a), repair.triangle(b), 0) && !repair.push_out(a, b))
                    repair.push_out(b, a);
    }
    return result;
}

}  // namespace surimi
