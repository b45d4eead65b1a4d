// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/starts.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>

#include "baker/unwrap/distortion.h"

namespace surimi {
namespace {

/// Scales the points to the patch's area, 1; false when a triangle is flipped, or squeezed below a share of its area.
bool scale_to_area(const Patch& patch, double least_share, std::vector<Vec2>& points) {
    double area = 0;
    for (size_t t = 0; t < patch.triangles.size(); ++t)
        area += patch.areas[t] * glm::determinant(jacobian(patch, points, t));
    if (!(area > 0) || !std::isfinite(area)) return false;
    for (Vec2& p : points) p /= std::sqrt(area);
    for (size_t t = 0; t < patch.triangles.size(); ++t)
        if (!(glm::determinant(jacobian(patch, points, t)) > least_share)) return false;
    return true;
}

void project(const Patch& patch, std::vector<Vec2>& points) {
    Vec3 sum(0);
    for (const auto& t : patch.triangles)
        sum += area_normal(patch.positions[t[0]], patch.positions[t[1]], patch.positions[t[2]]);
    const Vec3 axis = normalize_or(sum, Vec3(0, 0, 1));
    const Vec3 helper = std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(glm::cross(helper, axis));
    const Vec3 v = glm::cross(axis, u);  // u, v, axis are right-handed: fronts stay counter-clockwise
    points.clear();
    for (const Vec3& p : patch.positions) points.emplace_back(glm::dot(p, u), glm::dot(p, v));
}

/// Whether every triangle faces the mean normal enough for a projection to be a good start.
bool is_height_field(const Patch& patch, const std::vector<Vec2>& points) {
    constexpr double least_cosine = 0.25;
    for (size_t t = 0; t < patch.triangles.size(); ++t)
        if (!(glm::determinant(jacobian(patch, points, t)) > least_cosine)) return false;
    return true;
}

/// Lays the triangles beside each other, one after the other from the first, each scaled as the conformal map that
/// keeps the boundary's lengths would; then finds the points that fit their Jacobians best. For a developable patch all
/// of it is exact.
bool map_conformally(const Patch& patch, const std::vector<double>& scales, Laplacian& laplacian,
                     std::vector<Vec2>& points) {
    if (scales.empty()) return false;
    const size_t count = patch.triangles.size();
    // Lengths under the scales; at each corner, where the triangle lies when that corner is the origin and the edge to
    // the next one points along x.
    const auto length = [&](uint32_t a, uint32_t b) {
        return std::exp(0.5 * (scales[a] + scales[b])) * glm::length(patch.positions[b] - patch.positions[a]);
    };
    std::vector<double> turns(count, NAN);  // direction of each triangle's first edge
    const auto angle_at = [&](uint32_t t, uint32_t k) {
        const auto& c = patch.triangles[t];
        const double a = length(c[k], c[(k + 1) % 3]);
        const double b = length(c[k], c[(k + 2) % 3]);
        const double o = length(c[(k + 1) % 3], c[(k + 2) % 3]);
        const double cosine = (a * a + b * b - o * o) / (2 * a * b);
        const double sine_squared = 1 - cosine * cosine;
        return std::atan2(std::sqrt(std::max(0.0, sine_squared)), cosine);
    };
    // Direction of edge k of a triangle whose first edge points along `turn`.
    const auto direction = [&](uint32_t t, uint32_t k, double turn) {
        for (uint32_t i = 1; i <= k; ++i) turn += pi - angle_at(t, i);
        return turn;
    };
    std::vector<uint32_t> open{0};
    turns[0] = 0;
    for (size_t i = 0; i < open.size(); ++i) {
        const uint32_t t = open[i];
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t beyond = patch.neighbours[t][k];
            if (beyond == no_face || std::isfinite(turns[beyond])) continue;
            for (uint32_t j = 0; j < 3; ++j) {
                if (patch.triangles[beyond][j] != patch.triangles[t][(k + 1) % 3] ||
                    patch.triangles[beyond][(j + 1) % 3] != patch.triangles[t][k])
                    continue;
                turns[beyond] = direction(t, k, turns[t]) + pi - direction(beyond, j, 0);
                break;
            }
            if (!std::isfinite(turns[beyond])) return false;
            open.push_back(beyond);
        }
    }
    std::vector<Vec2> right(patch.positions.size(), Vec2(0));
    for (uint32_t t = 0; t < count; ++t) {
        const auto& c = patch.triangles[t];
        // A triangle's own frame has its first edge along x.
        const double scale = std::exp((scales[c[0]] + scales[c[1]] + scales[c[2]]) / 3);
        const Vec2 x = scale * Vec2(std::cos(turns[t]), std::sin(turns[t]));
        const glm::dmat2 target(x, Vec2(-x.y, x.x));
        for (size_t a = 0; a < 3; ++a) right[c[a]] += patch.areas[t] * (target * patch.gradients[t][a]);
    }
    if (!laplacian.factorize(std::vector<double>(count, 1.0))) return false;
    laplacian.solve(right, points);
    return true;
}

/// Vertices of the patch, and one more in every hole, which closes it.
bool map_to_circle(const Patch& patch, std::vector<Vec2>& points) {
    if (patch.loops.empty() || patch.euler_characteristic() != 2 - static_cast<int>(patch.loops.size())) return false;
    const auto length_of = [&](const std::vector<uint32_t>& loop) {
        double length = 0;
        for (size_t i = 0; i < loop.size(); ++i)
            length += glm::length(patch.positions[loop[(i + 1) % loop.size()]] - patch.positions[loop[i]]);
        return length;
    };
    size_t outer = 0;
    for (size_t i = 1; i < patch.loops.size(); ++i)
        if (length_of(patch.loops[i]) > length_of(patch.loops[outer])) outer = i;

    const size_t count = patch.positions.size();
    points.assign(count + patch.loops.size(), Vec2(0));
    std::vector<int> unknown(points.size(), 0);
    const auto& rim = patch.loops[outer];
    const double whole = length_of(rim);
    double along = 0;
    for (size_t i = 0; i < rim.size(); ++i) {
        const double angle = 2 * pi * along / whole;
        points[rim[i]] = Vec2(std::cos(angle), std::sin(angle)) / std::sqrt(pi);
        unknown[rim[i]] = -1;
        along += glm::length(patch.positions[rim[(i + 1) % rim.size()]] - patch.positions[rim[i]]);
    }
    unknown[count + outer] = -1;  // the rim is no hole
    int unknowns = 0;
    for (int& u : unknown) u = u < 0 ? -1 : unknowns++;
    if (unknowns == 0) {
        points.resize(count);
        return true;
    }

    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
    const auto connect_one_way = [&](uint32_t a, uint32_t b) {
        if (unknown[a] < 0) return;
        entries.emplace_back(unknown[a], unknown[a], 1.0);
        if (unknown[b] < 0)
            right.row(unknown[a]) += Eigen::RowVector2d(points[b].x, points[b].y);
        else if (unknown[b] < unknown[a])
            entries.emplace_back(unknown[a], unknown[b], -1.0);
    };
    const auto connect = [&](uint32_t a, uint32_t b) {
        connect_one_way(a, b);
        connect_one_way(b, a);
    };
    for (uint32_t t = 0; t < patch.triangles.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k)
            if (patch.neighbours[t][k] == no_face || patch.neighbours[t][k] > t)
                connect(patch.triangles[t][k], patch.triangles[t][(k + 1) % 3]);
    for (size_t i = 0; i < patch.loops.size(); ++i)
        if (i != outer)
            for (const uint32_t v : patch.loops[i]) connect(v, static_cast<uint32_t>(count + i));
    Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(laplacian);
    if (solver.info() != Eigen::Success) return false;
    const Eigen::MatrixX2d x = solver.solve(right);
    for (size_t v = 0; v < points.size(); ++v)
        if (unknown[v] >= 0) points[v] = Vec2(x(unknown[v], 0), x(unknown[v], 1));
    points.resize(count);
    return true;
}

}  // namespace

bool make_start(const Patch& patch, Start start, const std::vector<double>& logarithms, Laplacian& laplacian,
                std::vector<Vec2>& points) {
    switch (start) {
        case Start::projection:
            project(patch, points);
            return is_height_field(patch, points) && scale_to_area(patch, 0, points);
        case Start::conformal:
            return map_conformally(patch, logarithms, laplacian, points) && scale_to_area(patch, 1e-3, points);
        default:
            return map_to_circle(patch, points) && scale_to_area(patch, 0, points);
    }
}

}  // namespace surimi
