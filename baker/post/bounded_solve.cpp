// SPDX-License-Identifier: Apache-2.0
#include "baker/post/bounded_solve.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <vector>

namespace surimi {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// 1/2 x.A x - b.x is to be least with low <= x <= high.
struct Quadratic {
    Matrix matrix;  ///< A: symmetric, both triangles stored, positive definite
    Vector right;   ///< b
    Vector low;
    Vector high;
};

enum class Held : uint8_t { free, low, high };

constexpr double negligible = 1e-9;  // of visibility: far below the rounding of the float that it becomes

/// The matrix with held unknowns cut out, in the same pattern: their rows and columns are those of the identity.
Matrix without_held(const Matrix& matrix, const std::vector<Held>& held) {
    Matrix result = matrix;
    for (Eigen::Index column = 0; column < result.outerSize(); ++column) {
        for (Matrix::InnerIterator entry(result, column); entry; ++entry) {
            const bool is_held =
                held[static_cast<size_t>(entry.row())] != Held::free || held[static_cast<size_t>(column)] != Held::free;
            if (is_held) entry.valueRef() = entry.row() == column ? 1 : 0;
        }
    }
    return result;
}

/// Sets held unknowns to their bounds.
void hold(const Quadratic& problem, const std::vector<Held>& held, Vector& x) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const Held h = held[static_cast<size_t>(i)];
        if (h != Held::free) x[i] = h == Held::low ? problem.low[i] : problem.high[i];
    }
}

/// Which unknowns to hold next: those that are outside, and those held that press against their bound. Whether any
/// changed.
bool update(const Quadratic& problem, const Vector& x, std::vector<Held>& held) {
    const Vector slope = problem.matrix * x - problem.right;
    bool has_changed = false;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Held& h = held[static_cast<size_t>(i)];
        Held next = Held::free;
        if (h == Held::free && x[i] < problem.low[i] - negligible) next = Held::low;
        if (h == Held::free && x[i] > problem.high[i] + negligible) next = Held::high;
        if (h == Held::low && slope[i] > 0) next = Held::low;
        if (h == Held::high && slope[i] < 0) next = Held::high;
        has_changed = has_changed || next != h;
        h = next;
    }
    return has_changed;
}

/// Each unknown in turn goes to its best place between its bounds: slow, but never a step back.
void relax(const Quadratic& problem, Vector& x) {
    constexpr int most_sweeps = 1000;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double largest = 0;
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            double slope = -problem.right[i], diagonal = 0;
            for (Matrix::InnerIterator entry(problem.matrix, i); entry; ++entry) {
                slope += entry.value() * x[entry.row()];
                if (entry.row() == i) diagonal = entry.value();
            }
            const double next = std::clamp(x[i] - slope / diagonal, problem.low[i], problem.high[i]);
            largest = std::max(largest, std::abs(next - x[i]));
            x[i] = next;
        }
        if (largest < negligible) return;
    }
}

Vector as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Quadratic normal_equations(const BoundedLeastSquares& problem) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(problem.entries.size());
    for (const auto& [equation, unknown, value] : problem.entries)
        entries.push_back({static_cast<int>(unknown), static_cast<int>(equation), value});
    const auto size = static_cast<Eigen::Index>(problem.weights.size());
    Matrix transposed(size, static_cast<Eigen::Index>(problem.right.size()));
    transposed.setFromTriplets(entries.begin(), entries.end());
    entries = {};
    for (int i = 0; i < size; ++i) entries.push_back({i, i, problem.weights[static_cast<size_t>(i)]});
    Matrix own(size, size);
    own.setFromTriplets(entries.begin(), entries.end());
    const Matrix equations = transposed.transpose();
    return {transposed * equations + own, transposed * as_vector(problem.right), as_vector(problem.low),
            as_vector(problem.high)};
}

/// Where it is least.
Vector least(const Quadratic& problem) {
    constexpr int most_rounds = 30;  // of holding; mostly 2 to 5 are needed
    const auto size = static_cast<size_t>(problem.right.size());
    std::vector<Held> held(size, Held::free);
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver;
    solver.analyzePattern(problem.matrix);
    Vector x = Vector::Zero(problem.right.size());
    bool is_settled = false;
    for (int round = 0; round < most_rounds && !is_settled; ++round) {
        Vector bound = Vector::Zero(x.size());
        hold(problem, held, bound);
        Vector right = problem.right - problem.matrix * bound;
        hold(problem, held, right);
        solver.factorize(round == 0 ? problem.matrix : without_held(problem.matrix, held));
        if (solver.info() != Eigen::Success) break;
        x = solver.solve(right);
        is_settled = !update(problem, x, held);
    }
    x = x.cwiseMax(problem.low).cwiseMin(problem.high);
    if (!is_settled) relax(problem, x);
    return x;
}

}  // namespace

std::vector<double> solve(const BoundedLeastSquares& problem) {
    const Vector x = least(normal_equations(problem));
    return {x.begin(), x.end()};
}

}  // namespace surimi
