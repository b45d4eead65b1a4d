// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/laplacian.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>

namespace surimi {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

}  // namespace

struct Laplacian::Factorisation {
    Matrix matrix;  ///< the lower triangle
    std::vector<uint32_t>
        slots;  ///< in its values, of the pairs of corners (0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> solver;
};

Laplacian::Laplacian(const Patch& patch) : patch_(patch), factorisation_(std::make_unique<Factorisation>()) {
    const size_t count = patch.positions.size();
    std::vector<uint64_t> pairs;  // column, row
    pairs.reserve(count + 3 * patch.triangles.size());
    const auto pair_of = [](uint32_t a, uint32_t b) {
        return (static_cast<uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
    };
    for (uint32_t v = 0; v < count; ++v) pairs.push_back(pair_of(v, v));
    for (const auto& t : patch.triangles)
        for (size_t k = 0; k < 3; ++k) pairs.push_back(pair_of(t[k], t[(k + 1) % 3]));
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

    Matrix& matrix = factorisation_->matrix;
    matrix.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
    matrix.resizeNonZeros(static_cast<Eigen::Index>(pairs.size()));
    std::fill_n(matrix.outerIndexPtr(), count + 1, 0);
    for (size_t i = 0; i < pairs.size(); ++i) {
        ++matrix.outerIndexPtr()[(pairs[i] >> 32) + 1];
        matrix.innerIndexPtr()[i] = static_cast<int>(pairs[i] & UINT32_MAX);
        matrix.valuePtr()[i] = 0;
    }
    for (size_t v = 0; v < count; ++v) matrix.outerIndexPtr()[v + 1] += matrix.outerIndexPtr()[v];
    const auto slot_of = [&](uint32_t a, uint32_t b) {
        const int* const begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[std::min(a, b)];
        const int* const end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[std::min(a, b) + 1];
        const int* const at = std::lower_bound(begin, end, static_cast<int>(std::max(a, b)));
        return static_cast<uint32_t>(at - matrix.innerIndexPtr());
    };
    for (const auto& t : patch.triangles) {
        for (size_t k = 0; k < 3; ++k) factorisation_->slots.push_back(slot_of(t[k], t[k]));
        for (size_t k = 0; k < 3; ++k) factorisation_->slots.push_back(slot_of(t[k], t[(k + 1) % 3]));
    }
    factorisation_->solver.analyzePattern(matrix);
}

Laplacian::~Laplacian() = default;

bool Laplacian::factorize(const std::vector<double>& weights) {
    Matrix& matrix = factorisation_->matrix;
    std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
    double largest = 0;
    const uint32_t* slot = factorisation_->slots.data();
    for (size_t t = 0; t < patch_.triangles.size(); ++t) {
        const auto& g = patch_.gradients[t];
        const double weight = weights[t] * patch_.areas[t];
        for (size_t k = 0; k < 3; ++k) matrix.valuePtr()[*slot++] += weight * glm::dot(g[k], g[k]);
        for (size_t k = 0; k < 3; ++k) matrix.valuePtr()[*slot++] += weight * glm::dot(g[k], g[(k + 1) % 3]);
        largest = std::max(largest, weights[t]);
    }
    matrix.valuePtr()[matrix.outerIndexPtr()[0]] += largest;  // the diagonal comes first in its column
    factorisation_->solver.factorize(matrix);
    return factorisation_->solver.info() == Eigen::Success;
}

void Laplacian::solve(const std::vector<Vec2>& right, std::vector<Vec2>& x) const {
    const auto count = static_cast<Eigen::Index>(right.size());
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>> r(&right[0].x, count, 2);
    x.resize(right.size());
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>> result(&x[0].x, count, 2);
    result = factorisation_->solver.solve(Eigen::MatrixX2d(r));
}

}  // namespace surimi
