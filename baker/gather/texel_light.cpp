// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/texel_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "baker/gather/contacts.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

/// Sobol points of all texels: made once.
const SamplePoints& sample_points() {
    static const SamplePoints points;
    return points;
}

class Average {
  public:
    void add(const PointLight& light, double weight) {
        ++result_.points;
        weight_ += weight;
        PointLight& sum = result_.light;
        sum.unshadowed += weight * light.unshadowed;
        sum.shadowed += weight * light.shadowed;
        const double error = weight * light.unshadowed * light.error;
        squares_ += error * error;
        if (light.unshadowed > 0) {
            lowest_ = std::min(lowest_, light.visibility());
            highest_ = std::max(highest_, light.visibility());
        }
        sum.method = std::max(sum.method, light.method);
        sum.rays += light.rays;
        sum.segments += light.segments;
        sum.has_failed = sum.has_failed || light.has_failed;
        sum.is_dear = sum.is_dear || light.is_dear;
    }
    /// The points since the last one lay on one piece of this share.
    void end_piece(double share) {
        result_.spread += share * std::max(0.0, highest_ - lowest_);
        lowest_ = 1, highest_ = 0;
    }
    bool is_usable() const { return result_.light.is_usable(); }
    TexelLight value() const {
        TexelLight average = result_;
        average.light.error = average.light.unshadowed > 0 ? std::sqrt(squares_) / average.light.unshadowed : 0;
        average.light.unshadowed /= weight_ > 0 ? weight_ : 1;
        average.light.shadowed /= weight_ > 0 ? weight_ : 1;
        return average;
    }

  private:
    TexelLight result_;
    double squares_ = 0, weight_ = 0;
    double lowest_ = 1, highest_ = 0;  // visibility of a piece's points
};

/// Cells a side of a piece that has this share of a texel with side x side cells. Pieces that matter get more with
/// every step, or two steps would agree about them whatever they are like.
int cells_of(double share, int side) {
    const int least = share > 0.03 ? side / 2 : 1;
    return std::max(least, static_cast<int>(std::ceil(side * std::sqrt(share) - 0.3)));
}

/// Points that average_over_cells takes.
double points_of(const TexelSurface& surface, int side) {
    if (surface.pieces().size() > most_parts_of_texel) return side * side;
    double sum = 0;
    for (const TexelSurface::Piece& piece : surface.pieces()) {
        const int cells = cells_of(surface.share_of(piece), side);
        sum += cells * cells;
    }
    return sum;
}

/// Calls visit(middle) for side x side cells of the unit square.
template <class Visit>
void for_each_cell(int side, const Visit& visit) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) visit(Vec2(x + 0.5, y + 0.5) / static_cast<double>(side));
}

/// Adds what a step of the refinement cost to the next one's account.
TexelLight with_cost_of(TexelLight value, const TexelLight& before) {
    value.points += before.points;
    value.light.rays += before.light.rays;
    value.light.segments += before.light.segments;
    return value;
}

/// The exact way to average where shadows are sharper than a sixteenth of the texel: scrambled points, four times as
/// many at every step, until two steps agree.
TexelLight by_many_points(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface, uint64_t key,
                          PointWorkspace& work) {
    constexpr uint32_t most_points = 1024;
    const Scrambling seeds = scrambling(hash(key, 99));
    const Tolerances& limits = setup.limits;
    Average average;
    double before = -1;
    for (uint32_t i = 0; i < most_points; ++i) {
        const auto r = scrambled(sobol::point(i), seeds);
        average.add(light_at(setup, sight, surface.sample(r[0], r[1]), {hash(key, 100 + i), 64}, work), 1);
        if (i + 1 != 64 && i + 1 != 256 && i + 1 != most_points) continue;
        TexelLight value = average.value();
        const double change = before < 0 ? 1 : std::abs(value.light.visibility() - before);
        value.light.error = std::hypot(value.light.error, change / 2);
        if (change / 2 <= limits.footprint || i + 1 == most_points) return value;
        before = value.light.visibility();
    }
    return average.value();
}

}  // namespace

TexelLight average_over_cells(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface, int side,
                              uint64_t key, PointWorkspace& work) {
    Average average;
    uint64_t number = hash(key, static_cast<uint64_t>(side));
    const double points = points_of(surface, side);
    const auto add = [&](const SurfacePoint& point, double weight) {
        if (average.is_usable()) average.add(light_at(setup, sight, point, {++number, points}, work), weight);
    };
    if (surface.pieces().size() > most_parts_of_texel) {
        for_each_cell(side, [&](const Vec2& cell) { add(surface.sample(cell.x, cell.y), 1); });
        average.end_piece(1);
        return average.value();
    }
    for (const TexelSurface::Piece& piece : surface.pieces()) {
        const double share = surface.share_of(piece);
        const int cells = cells_of(share, side);
        for_each_cell(cells, [&](Vec2 cell) {
            if (!piece.is_square) {  // evenly by area (M8); one cell has its middle at the centroid
                cell.x = cells == 1 ? 2.0 / 3 : std::sqrt(cell.x);
                cell.y *= cell.x;
            }
            add(TexelSurface::point_of(piece, cell), share / (cells * cells));
        });
        average.end_piece(share);
    }
    return average.value();
}

namespace {

/// Of the monitor no more than what some place of the texel has above its horizon, and a little around it: of a monitor
/// that just rises over the horizon most samples would be lost.
MonitorSampler sampler_above_horizon(const MonitorSetup& setup, const TexelSurface& surface) {
    const Vec3 normal = surface.center().normal;
    double lowest = INFINITY, deviation = 0, farthest = 0;
    surface.for_each_corner([&](const SurfacePoint& corner) {
        lowest = std::min(lowest, glm::dot(normal, corner.position));
        deviation = std::max(deviation, glm::length(corner.normal - normal));
        for (const Polygon& panel : setup.light().panels)
            for (const Vec3& place : panel.corners) farthest = std::max(farthest, glm::length(place - corner.position));
    });
    if (deviation > 0.5) return setup.sampler;
    // dot(n, q - p) <= dot(normal, q) - lowest + |n - normal| |q - p|, and half an ulp of coordinates for what is flat.
    const double rounding = 1e-7 * (farthest + largest_component(surface.center().position));
    return setup.sampler.above(normal, lowest - deviation * farthest - rounding);
}

}  // namespace

TexelLight by_rays(const MonitorSetup& setup, const TexelSurface& surface, double unshadowed, double error,
                   uint64_t key) {
    const MonitorSampler sampler = sampler_above_horizon(setup, surface);
    MonteCarloTask task{setup.rays, sampler, sample_points()};
    task.monitor = setup.monitor;
    task.clearance = setup.largest_clearance();
    task.error = error;
    task.samples = setup.settings.samples;
    task.key = hash(key, 1);
    const MonteCarloEstimate estimate = monte_carlo(task, surface);
    TexelLight value;
    value.points = 1;
    value.light.method = TexelMethod::monte_carlo;
    value.light.rays = estimate.rays;
    value.light.unshadowed = unshadowed;
    value.light.shadowed = unshadowed * estimate.visibility;
    value.light.error = estimate.error;
    return value;
}

namespace {

/// How much the rims of a texel's larger pieces differ from what their middles say: the mean of the corners is that of
/// a plane wherever light is smooth, and not where a shadow lies along a side. `spent` gets the points.
double rim_difference(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface, uint64_t key,
                      PointWorkspace& work, TexelLight& spent) {
    // A little inside, since corners themselves lie on what stands there; what is narrower is below the error.
    const double inset = std::min(0.04, setup.settings.error);
    constexpr double large = 0.05;
    double sum = 0;
    for (const TexelSurface::Piece& piece : surface.pieces()) {
        const double share = surface.share_of(piece);
        if (share < large) continue;
        const auto visibility_at = [&](const Vec2& uv) {
            const PointLight light =
                light_at(setup, sight, TexelSurface::point_of(piece, uv), {hash(key, 50), 5}, work);
            ++spent.points;
            spent.light.rays += light.rays;
            spent.light.segments += light.segments;
            return light.visibility();
        };
        const Vec2 middle = piece.middle();
        const std::array<Vec2, 4> corners = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
        const size_t count = piece.is_square ? 4 : 3;
        double mean = 0;
        for (size_t i = 0; i < count; ++i)
            mean += visibility_at(glm::mix(corners[i], middle, inset)) / static_cast<double>(count);
        sum += share * std::abs(mean - visibility_at(middle));
    }
    return sum;
}

}  // namespace

TexelLight refined(const MonitorSetup& setup, const BlockSight& sight, const TexelSurface& surface,
                   const Beginning& from, uint64_t key, PointWorkspace& work) {
    const Tolerances& limits = setup.limits;
    const bool may_trace = setup.settings.method == Method::automatic;
    const double cost_of_point =
        cost_of_projecting(sight.candidates()) + cost_of_scan(work.segments.count, limits.first_lines);
    constexpr int first_side = 2;
    const auto are_rays_cheaper_than = [&](double points) {
        return may_trace && points * cost_of_point > cost_of_average_by_rays(limits.monte_carlo);
    };
    TexelLight best{from.center, 1};
    double rim = 0, change_before = 1;
    // Where what is known makes it likely that rays will be needed, they are taken at once.
    const double at_least = points_of(surface, from.is_unlike_center ? 2 * first_side : first_side);
    const bool is_hopeless = are_rays_cheaper_than(from.has_rim ? at_least + 5 : at_least) ||
                             (may_trace && surface.pieces().size() > most_parts_of_texel);
    if (from.has_rim && !is_hopeless) rim = rim_difference(setup, sight, surface, key, work, best);
    for (int side = first_side; side <= 16 && !is_hopeless && !are_rays_cheaper_than(points_of(surface, side));
         side *= 2) {
        TexelLight next = average_over_cells(setup, sight, surface, side, key, work);
        const double change = std::abs(next.light.visibility() - best.light.visibility());
        next = with_cost_of(next, best);
        best = next;
        // Halving the cells leaves a quarter of the error where light is smooth: a third of what the step changed.
        const double left_by_change = change / 3;
        best.light.error = std::hypot(next.light.error, left_by_change);
        if (!best.light.is_usable()) break;
        if (from.is_unlike_center && side == first_side) continue;
        // Two steps can agree by chance where a shadow's edge misses their points.
        const double at_center = std::isfinite(from.footprint) && !from.is_cut ? from.footprint : next.spread / 4;
        const double by_neighbours = at_center / (side * side);
        // A strip along a side that the cells' middles miss is half a cell wide at most.
        const double expected = std::max(by_neighbours, rim / (2 * side));
        if (std::max(left_by_change, expected) <= limits.footprint) return best;
        if (side > first_side && change > 0.6 * change_before) break;  // not smooth at all
        change_before = change;
        double points = side * side, left = std::max(left_by_change, expected);
        for (; left > limits.footprint; left /= 4) points *= 4;
        if (are_rays_cheaper_than(points)) break;
    }
    if (may_trace) return with_cost_of(by_rays(setup, surface, best.light.unshadowed, limits.monte_carlo, key), best);
    return with_cost_of(by_many_points(setup, sight, surface, key, work), best);
}

}  // namespace surimi
