// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/relax.h"

#include <algorithm>

#include "baker/unwrap/starts.h"

namespace surimi {
namespace {

/// What one triangle adds to a step: the weight of its proxy and the gradient of its energy.
struct Proxy {
    glm::dmat2 weight;    ///< W^T W (M42)
    glm::dmat2 gradient;  ///< half the derivative of the energy by the Jacobian
};

Proxy make_proxy(const glm::dmat2& j) {
    // J = S R: R turns, S stretches (polar decomposition). a is twice the part of J that turns and scales.
    const Vec2 a(j[0].x + j[1].y, j[0].y - j[1].x);
    const double p = glm::length(a);  // sum of the singular values
    const double q = glm::determinant(j);
    const glm::dmat2 r(Vec2(a.x, a.y) / p, Vec2(-a.y, a.x) / p);
    const glm::dmat2 s = j * glm::transpose(r);
    const double q2 = q * q;
    const double q3 = q2 * q;
    const double r2 = p * p - q;  // s1^2 + s1 s2 + s2^2
    const double constant = 1 + p / q + r2 / q2 + p * (r2 - q) / q3;
    const double linear = -(1 / q + p / q2 + r2 / q3);
    Proxy proxy;
    proxy.weight = glm::dmat2(constant) + linear * s;
    proxy.gradient = proxy.weight * (j - r);
    return proxy;
}

/// The quadratic problem of one step: proxies of all triangles (M42).
class StepSystem {
  public:
    StepSystem(const Patch& patch, Laplacian& laplacian) : patch_(patch), laplacian_(laplacian) {}

    /// False when the points cannot be improved upon within rounding.
    bool prepare(const std::vector<Vec2>& points) {
        weights_.resize(patch_.triangles.size());
        right_.assign(points.size(), Vec2(0));
        std::vector<double> means(patch_.triangles.size());
        for (size_t t = 0; t < patch_.triangles.size(); ++t) {
            const Proxy proxy = make_proxy(jacobian(patch_, points, t));
            weights_[t] = patch_.areas[t] * proxy.weight;
            means[t] = 0.5 * (proxy.weight[0][0] + proxy.weight[1][1]);
            for (size_t a = 0; a < 3; ++a)
                right_[patch_.triangles[t][a]] -= patch_.areas[t] * (proxy.gradient * patch_.gradients[t][a]);
        }
        // A factorisation serves until the weights have moved away from it.
        if (iterations_ <= patient_iterations) return true;
        iterations_ = 0;
        return laplacian_.factorize(means);
    }

    /// Conjugate gradients, as exact as a step has to be.
    void solve(std::vector<Vec2>& moves) {
        const size_t count = right_.size();
        moves.assign(count, Vec2(0));
        std::vector<Vec2> residual = right_;
        std::vector<Vec2> better;
        laplacian_.solve(residual, better);
        std::vector<Vec2> direction = better;
        std::vector<Vec2> image(count);
        double product = dot(residual, better);
        const double enough = 1e-2 * product;  // the norm falls to 10 %
        constexpr int most_iterations = 30;
        for (iterations_ = 0; iterations_ < most_iterations && product > enough; ++iterations_) {
            apply(direction, image);
            const double curvature = dot(direction, image);
            if (!(curvature > 0)) return;
            const double length = product / curvature;
            for (size_t v = 0; v < count; ++v) {
                moves[v] += length * direction[v];
                residual[v] -= length * image[v];
            }
            laplacian_.solve(residual, better);
            const double next = dot(residual, better);
            const double keep = next / product;
            for (size_t v = 0; v < count; ++v) direction[v] = better[v] + keep * direction[v];
            product = next;
        }
    }

  private:
    static constexpr int patient_iterations = 12;

    static double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
        double sum = 0;
        for (size_t v = 0; v < a.size(); ++v) sum += glm::dot(a[v], b[v]);
        return sum;
    }

    void apply(const std::vector<Vec2>& x, std::vector<Vec2>& image) const {
        std::fill(image.begin(), image.end(), Vec2(0));
        for (size_t t = 0; t < patch_.triangles.size(); ++t) {
            const glm::dmat2 change = weights_[t] * jacobian(patch_, x, t);
            for (size_t a = 0; a < 3; ++a) image[patch_.triangles[t][a]] += change * patch_.gradients[t][a];
        }
    }

    const Patch& patch_;
    Laplacian& laplacian_;
    std::vector<glm::dmat2> weights_;  ///< area times W^T W
    std::vector<Vec2> right_;
    int iterations_ = patient_iterations + 1;
};

/// The smallest positive step at which a triangle becomes flat.
double first_flat_step(const Vec2& u, const Vec2& v, const Vec2& du, const Vec2& dv) {
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
    const double c = cross(u, v);
    const double b = cross(u, dv) + cross(du, v);
    const double a = cross(du, dv);
    const double d = b * b - 4 * a * c;
    if (!(d >= 0)) return INFINITY;
    const double q = -0.5 * (b + std::copysign(std::sqrt(d), b));
    double first = INFINITY;
    for (const double root : {q / a, c / q})
        if (root > 0) first = std::min(first, root);  // false for NaN
    return first;
}

double largest_step(const Patch& patch, const std::vector<Vec2>& points, const std::vector<Vec2>& moves) {
    double largest = 1;
    constexpr double safety = 0.9;  // stays clear of flat triangles, whose energy is infinite
    for (const auto& t : patch.triangles) {
        const Vec2& p = points[t[0]];
        const Vec2& m = moves[t[0]];
        const double step = first_flat_step(points[t[1]] - p, points[t[2]] - p, moves[t[1]] - m, moves[t[2]] - m);
        largest = std::min(largest, safety * step);
    }
    return largest;
}

constexpr int most_iterations = 40;

}  // namespace

void relax(const Patch& patch, double bound, Laplacian& laplacian, std::vector<Vec2>& points) {
    double energy = symmetric_dirichlet(patch, points);
    StepSystem system(patch, laplacian);
    std::vector<Vec2> moves;
    std::vector<Vec2> moved(points.size());
    for (int i = 0; i < most_iterations; ++i) {
        if (!system.prepare(points)) return;
        system.solve(moves);
        double step = largest_step(patch, points, moves);
        double lower = INFINITY;
        constexpr int most_halvings = 24;
        for (int k = 0; k < most_halvings; ++k, step *= 0.5) {
            for (size_t v = 0; v < points.size(); ++v) moved[v] = points[v] + step * moves[v];
            lower = symmetric_dirichlet(patch, moved);
            if (lower < energy) break;
        }
        if (!(lower < energy)) return;
        const double fall = energy - lower;
        std::swap(points, moved);
        energy = lower;
        // Steps converge linearly, the next ones together fall by about as much again while far from the end.
        if (fall < 0.02 * (energy - 4) || fall < 1e-6) return;
        if (energy - bound > 6 * fall) return;
    }
}

std::optional<Flattening> flatten_within(const Patch& patch, const std::vector<double>& logarithms,
                                         const DistortionBound& bound) {
    Flattening result;
    Laplacian laplacian(patch);
    for (const Start start : {Start::projection, Start::conformal, Start::tutte}) {
        if (!make_start(patch, start, logarithms, laplacian, result.points)) continue;
        relax(patch, bound.energy, laplacian, result.points);
        result.distortion = measure_distortion(patch, result.points);
        if (is_within(result.distortion, bound)) return result;
        return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace surimi
