// SPDX-License-Identifier: Apache-2.0
#include "runtime/ltc/fit/fit_cell.h"

#include <limits>

#include "runtime/ltc/fit/nelder_mead.h"

namespace surimi {

namespace {

using Numbers = std::array<double, 4>;

Numbers numbers_of(const LobeShape& s) {
    return {s.along, s.lift, s.skew, s.depth};
}

LobeShape shape_of(const Numbers& n) {
    return {n[0], n[1], n[2], n[3]};
}

/// Points in bands along the plane of incidence, crowded in it and at both horizons: grazing lobes can become blades
/// from one horizon to the other, which the nodes of the BRDF would not see. `width` is that of the bands.
struct Bands {
    double width;

    /// Point (t, s), both in (0, 1).
    Vec3 at(double t, double s) const {
        const double across = std::atan(width * std::tan(pi / 2 * s * s)), turn = pi * t * t * (3 - 2 * t);
        return {-std::cos(across) * std::cos(turn), std::sin(across), std::cos(across) * std::sin(turn)};
    }
    /// Of these points in 1/sr; counts the mirror image at -y.
    double density(const Vec3& w) const {
        const double radius = std::hypot(w.x, w.z), tangent = w.y / radius;
        const double t = 0.5 - std::sin(std::asin(1 - 2 * std::atan2(w.z, -w.x) / pi) / 3);  // inverse of the cubic
        const double s = std::sqrt(std::atan(tangent / width) * 2 / pi);
        // The derivative of `across` by s: pi s (width^2 + tan^2) / (width (1 + tan^2)).
        const double by_s = pi * s * (width * width + tangent * tangent) / (width * (1 + tangent * tangent));
        const double density = 1 / (2 * radius * 6 * pi * t * (1 - t) * by_s);
        return std::isfinite(density) ? density : 0;
    }
};

}  // namespace

FitCell::FitCell(double alpha, double cosine, const FitSettings& settings, LobePart part)
    : albedo(ggx_albedo(alpha, cosine)), alpha_(alpha), cosine_(cosine), settings_(settings) {
    const Vec3 view(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
    const Bands bands{std::hypot(cosine, alpha * view.x)};
    // Two quadratures, each weighted with its share of the sum of both densities.
    const double total = part == LobePart::full ? albedo.full : albedo.fresnel;
    const auto add = [&](const Vec3& light, double value, double weight) {
        if (part == LobePart::schlick)
            value *= std::pow(std::max(0.0, 1 - glm::dot(view, normalize_or(view + light, {0, 0, 1}))), 5);
        x_.push_back(light.x);
        y_.push_back(light.y);
        z_.push_back(light.z);
        value_.push_back(value / total);
        weight_.push_back(weight);
        norm_ += weight * std::pow(value / total, 1.5);
    };
    for (const GgxNode& node : ggx_nodes(alpha, cosine, settings.around, settings.along)) {
        const double own = ggx_density(alpha, view, node.light), other = bands.density(node.light);
        add(node.light, node.value, node.weight * own / (own + other));
    }
    for (int i = 0; i < settings.bands; ++i)
        for (int j = 0; j < settings.bands; ++j) {
            const Vec3 light = bands.at((i + 0.5) / settings.bands, (j + 0.5) / settings.bands);
            const double own = bands.density(light), other = ggx_density(alpha, view, light);
            if (!(own > 0)) continue;
            const double count = static_cast<double>(settings.bands) * settings.bands;
            add(light, ggx_times_cosine(alpha, view, light), 1 / (count * (own + other)));
        }
}

double FitCell::objective(const Mat3& m) const {
    const double determinant = m[0].x * m[2].z - m[2].x * m[0].z, shown = 1 - lobe_below_horizon(m);
    if (!(determinant > 0) || !(shown > 1e-3)) return std::numeric_limits<double>::infinity();
    const double factor = determinant / (pi * shown);
    double sum = 0;
    for (size_t i = 0; i < x_.size(); ++i) {
        const double qx = m[0].x * x_[i] + m[2].x * z_[i], qz = m[0].z * x_[i] + m[2].z * z_[i];
        const double length2 = qx * qx + y_[i] * y_[i] + qz * qz;
        const double difference = std::abs(value_[i] - factor * std::max(0.0, qz) / (length2 * length2));
        sum += weight_[i] * difference * std::sqrt(difference);
    }
    return sum / norm_;
}

FitError FitCell::error(const LobeShape& shape) const {
    return error(inverse_matrix(shape, alpha_, cosine_));
}

FitError FitCell::error(const Mat3& m) const {
    const double shown = 1 - lobe_below_horizon(m);
    double sum = 0;
    for (size_t i = 0; i < x_.size(); ++i)
        sum += weight_[i] * std::abs(value_[i] - lobe_density(m, {x_[i], y_[i], z_[i]}) / shown);
    return {objective(m), sum / 2};
}

LobeShape FitCell::fit(const LobeShape& start, const LobeShape& neighbour) const {
    if (cosine_ == 1) {
        const auto f = [&](const std::array<double, 1>& n) {
            const double distance = n[0] - neighbour.depth;
            return objective(inverse_matrix({1, 0, 0, n[0]}, alpha_, cosine_)) +
                   settings_.stiffness * distance * distance;
        };
        std::array<double, 1> best{start.depth};
        for (int i = 0; i < settings_.restarts; ++i) best = minimize<1>(f, best, settings_.step, 1e-12, 200).at;
        return {1, 0, 0, best[0]};
    }
    const Numbers home = numbers_of(neighbour);
    const auto f = [&](const Numbers& n) {
        double distance2 = 0;
        for (size_t k = 0; k < 4; ++k) distance2 += (n[k] - home[k]) * (n[k] - home[k]);
        return objective(inverse_matrix(shape_of(n), alpha_, cosine_)) + settings_.stiffness * distance2;
    };
    Numbers best = numbers_of(start);
    for (int i = 0; i < settings_.restarts; ++i) best = minimize<4>(f, best, settings_.step, 1e-7, 400).at;
    return shape_of(best);
}

}  // namespace surimi
