// SPDX-License-Identifier: Apache-2.0
#include "runtime/ltc/ggx.h"

#include <cassert>

namespace surimi {

namespace {

/// Smith's ratio of hidden to visible microsurface, Lambda, of a direction above the horizon.
double smith(double alpha, const Vec3& d) {
    const double slope2 = alpha * alpha * (d.x * d.x + d.y * d.y) / (d.z * d.z);
    return slope2 / (2 * (1 + std::sqrt(1 + slope2)));  // (sqrt(1 + s) - 1) / 2 without cancellation
}

/// Density of microfacet normals over projected area.
double ggx_normals(double alpha, const Vec3& h) {
    const double a2 = alpha * alpha, q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
    return a2 / (pi * q * q);
}

Vec3 half_vector(const Vec3& view, const Vec3& light) {
    return normalize_or(view + light, {0, 0, 1});
}

/// The view in the space where the microsurface is a hemisphere.
Vec3 stretched(double alpha, const Vec3& view) {
    return normalize_or({alpha * view.x, alpha * view.y, view.z}, {0, 0, 1});
}

/// The microfacet that mirrors the stretched view into the cap's point (radius, azimuth, z), in true space.
Vec3 facet(double alpha, const Vec3& stretched_view, double azimuth, double z) {
    const double radius = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    const Vec3 h = stretched_view + Vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
    return normalize_or({alpha * h.x, alpha * h.y, std::max(0.0, h.z)}, {0, 0, 1});
}

Vec3 mirrored(const Vec3& view, const Vec3& h) {
    return 2 * glm::dot(view, h) * h - view;
}

struct Rule {
    std::vector<double> at, weight;
};

/// Gauss and Legendre's rule on [0, 1]: roots of P_n by Newton, from Tricomi's estimates.
Rule gauss_legendre(int n) {
    Rule rule;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 8; ++step) {
            double p = 1, before = 0;
            for (int k = 1; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        rule.at.push_back((1 + x) / 2);
        rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

}  // namespace

double ggx_times_cosine(double alpha, const Vec3& view, const Vec3& light) {
    if (!(view.z > 0) || !(light.z > 0)) return 0;
    const double visible = 1 / (1 + smith(alpha, view) + smith(alpha, light));
    return ggx_normals(alpha, half_vector(view, light)) * visible / (4 * view.z);
}

Vec3 sample_ggx(double alpha, const Vec3& view, double u, double v) {
    const Vec3 w = stretched(alpha, view);
    // Points of the sphere above -w.z, even by area (Dupuy and Benyoub 2023).
    return mirrored(view, facet(alpha, w, 2 * pi * u, (1 - v) * (1 + w.z) - w.z));
}

double ggx_density(double alpha, const Vec3& view, const Vec3& light) {
    const Vec3 h = half_vector(view, light);
    if (!(view.z > 0) || !(h.z > 0)) return 0;
    return ggx_normals(alpha, h) / (4 * view.z * (1 + smith(alpha, view)));
}

std::vector<GgxNode> ggx_nodes(double alpha, double cosine, int around, int along) {
    assert(alpha > 0 && alpha <= 1 && cosine > 0 && cosine <= 1);
    const Vec3 view(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
    const double tangent = view.x / cosine;
    const Rule turns = gauss_legendre(around / 2), radii = gauss_legendre(along);
    std::vector<GgxNode> nodes;
    nodes.reserve(2 * turns.at.size() * radii.at.size());
    for (size_t i = 0; i < 2 * turns.at.size(); ++i) {
        // A quarter turn towards the view and one away from it, with nodes crowded at both ends: where the quarters
        // meet, the distance to the horizon changes within about cosine / alpha; in the plane of incidence, fitted
        // lobes have wings that are narrow in azimuth.
        const size_t k_turn = i % turns.at.size();
        const double side = i < turns.at.size() ? 1 : -1, t = turns.at[k_turn];
        const double turn = pi / 2 * t * t * (3 - 2 * t), d_azimuth = 3 * pi * t * (1 - t) * turns.weight[k_turn];
        const double x = side * std::sin(turn), y = std::cos(turn);
        const double root = std::hypot(1.0, tangent * x);
        const double horizon = x > 0 ? root + tangent * x : 1 / (root - tangent * x);
        const double end = std::atan2(horizon, alpha);
        for (size_t k = 0; k < radii.at.size(); ++k) {
            // Shadowing takes over within about alpha of the horizon, so the nodes crowd there, too.
            const double rest = 1 - radii.at[k], psi = end * (1 - rest * rest), slope = alpha * std::tan(psi);
            const Vec3 h = normalize_or({slope * x, slope * y, 1}, {0, 0, 1}), light = mirrored(view, h);
            if (!(light.z > 0)) continue;  // rounding next to the horizon
            const double normals = ggx_normals(alpha, h) / (4 * cosine);
            const double facets = std::sin(2 * psi) * 2 * rest * end * radii.weight[k] * d_azimuth / pi;
            const double value = normals / (1 + smith(alpha, view) + smith(alpha, light));
            nodes.push_back({light, glm::dot(view, h), value, facets * (1 + tangent * slope * x) / normals});
        }
    }
    return nodes;
}

GgxAlbedo ggx_albedo(double alpha, double cosine) {
    GgxAlbedo sum{0, 0};
    for (const GgxNode& node : ggx_nodes(alpha, cosine, 128, 128)) {
        const double part = node.value * node.weight;
        sum.full += part;
        sum.fresnel += part * std::pow(1 - node.half_cosine, 5);
    }
    return sum;
}

}  // namespace surimi
