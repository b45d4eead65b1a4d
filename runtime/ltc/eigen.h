// SPDX-License-Identifier: Apache-2.0
// Eigenvalues and axes of a symmetric 3 x 3 matrix, by Jacobi's rotations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/base/math.h"

namespace surimi {

template <class T>
struct SymmetricEigen {
    std::array<T, 3> values{0, 0, 0};  ///< descending
    glm::mat<3, 3, T> axes{1};         ///< column i belongs to values[i]; orthonormal, right-handed
};

/// Eigen-decomposition of the symmetric matrix whose upper triangle is that of `matrix`, by cyclic Jacobi rotations
/// (M9). The error is a few epsilon of the largest entry; of a matrix whose rows are graded (entries that fall away
/// along the diagonal, each with small relative error) small eigenvalues keep their own digits too. Scaled inside, so
/// any magnitude will do. The zero matrix has values 0 and the identity's axes; so has one that is not finite, and
/// FE_INVALID is raised.
template <class T>
SymmetricEigen<T> eigen_of_symmetric(glm::mat<3, 3, T> matrix) {
    SymmetricEigen<T> result;
    T scale = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) {
            if (!std::isfinite(matrix[j][i])) return flagged(result);
            scale = std::max(scale, std::abs(matrix[j][i]));
        }
    if (!(scale > 0)) return result;
    // Two steps, because 1 / scale overflows for a denormal scale.
    std::array<std::array<T, 3>, 3> m{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = i; j < 3; ++j) m[i][j] = m[j][i] = matrix[static_cast<int>(j)][static_cast<int>(i)] / scale;

    auto& axes = result.axes;
    const auto rotate = [&](size_t p, size_t q) {
        const T off = m[p][q];
        if (off == 0) return;
        const T theta = (m[q][q] - m[p][p]) / (2 * off);  // infinite when `off` is negligible: then t is 0
        const T t = std::copysign(1 / (std::abs(theta) + std::hypot(theta, T(1))), theta);
        const T cosine = 1 / std::sqrt(t * t + 1), sine = t * cosine;
        const size_t r = 3 - p - q;
        m[p][p] -= t * off;
        m[q][q] += t * off;
        m[p][q] = m[q][p] = 0;
        const T rp = m[r][p], rq = m[r][q];
        m[r][p] = m[p][r] = cosine * rp - sine * rq;
        m[r][q] = m[q][r] = sine * rp + cosine * rq;
        const auto axis_p = axes[static_cast<int>(p)], axis_q = axes[static_cast<int>(q)];
        axes[static_cast<int>(p)] = cosine * axis_p - sine * axis_q;
        axes[static_cast<int>(q)] = sine * axis_p + cosine * axis_q;
    };
    // Quadratic convergence: 4 to 6 sweeps for double. The bound is for equal or zero values, which never get "small".
    constexpr int max_sweeps = 16;
    for (int sweep = 0; sweep < max_sweeps && (m[0][1] != 0 || m[0][2] != 0 || m[1][2] != 0); ++sweep) {
        rotate(0, 1);
        rotate(0, 2);
        rotate(1, 2);
    }
    for (size_t i = 0; i < 3; ++i) result.values[i] = m[i][i] * scale;
    for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
        if (result.values[static_cast<size_t>(i)] >= result.values[static_cast<size_t>(j)]) continue;
        std::swap(result.values[static_cast<size_t>(i)], result.values[static_cast<size_t>(j)]);
        std::swap(axes[i], axes[j]);
    }
    if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0) axes[2] = -axes[2];
    return result;
}

}  // namespace surimi
