// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/curvature.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace surimi {
namespace {

/// 2 pi less the angles around each vertex.
std::vector<double> angle_defects(const Patch& patch) {
    std::vector<double> defects(patch.positions.size(), 2 * pi);
    for (const auto& t : patch.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 u = patch.positions[t[(k + 1) % 3]] - patch.positions[t[k]];
            const Vec3 v = patch.positions[t[(k + 2) % 3]] - patch.positions[t[k]];
            defects[t[k]] -= std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
        }
    }
    return defects;
}

}  // namespace

std::vector<double> conformal_logarithms(const Patch& patch) {
    if (patch.loops.empty()) return {};
    std::vector<int> unknown(patch.positions.size(), 0);
    for (const auto& loop : patch.loops)
        for (const uint32_t v : loop) unknown[v] = -1;
    int unknowns = 0;
    for (int& u : unknown) u = u < 0 ? -1 : unknowns++;
    std::vector<double> result(patch.positions.size(), 0.0);
    if (unknowns == 0) return result;

    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(6 * patch.triangles.size());
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        for (size_t a = 0; a < 3; ++a) {
            for (size_t b = 0; b < 3; ++b) {
                const int i = unknown[patch.triangles[t][a]];
                const int j = unknown[patch.triangles[t][b]];
                if (i >= j && j >= 0)
                    entries.emplace_back(i, j, patch.areas[t] * glm::dot(patch.gradients[t][a], patch.gradients[t][b]));
            }
        }
    }
    Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(laplacian);
    if (solver.info() != Eigen::Success) return {};
    const std::vector<double> defects = angle_defects(patch);
    Eigen::VectorXd right(unknowns);
    for (size_t v = 0; v < unknown.size(); ++v)
        if (unknown[v] >= 0) right[unknown[v]] = defects[v];
    const Eigen::VectorXd x = solver.solve(right);
    if (!x.allFinite()) return {};
    for (size_t v = 0; v < unknown.size(); ++v)
        if (unknown[v] >= 0) result[v] = -x[unknown[v]];
    return result;
}

double predicted_energy(const Patch& patch, const std::vector<double>& logarithms) {
    if (logarithms.empty()) return INFINITY;
    double mean = 0;
    double squares = 0;
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        for (const uint32_t v : patch.triangles[t]) {
            mean += patch.areas[t] / 3 * logarithms[v];
            squares += patch.areas[t] / 3 * logarithms[v] * logarithms[v];
        }
    }
    // A conformal map with these scales has 4 + 8 var(u); giving up angles for areas saves about half of it.
    constexpr double saved = 0.5;
    const double energy = 4 + saved * 8 * (squares - mean * mean);
    return std::isfinite(energy) ? energy : INFINITY;
}

}  // namespace surimi
