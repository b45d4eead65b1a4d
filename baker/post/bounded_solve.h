// SPDX-License-Identifier: Apache-2.0
// The least of a quadratic function between bounds.
#pragma once

#include <Eigen/SparseCore>

namespace surimi {

/// 1/2 x.A x - b.x is to be least with low <= x <= high.
struct BoundedQuadratic {
    Eigen::SparseMatrix<double> matrix;  ///< A: symmetric, both triangles stored, positive definite
    Eigen::VectorXd right;               ///< b
    Eigen::VectorXd low;                 ///< low <= 0 <= high
    Eigen::VectorXd high;
};

/// Where it is least, always within the bounds (M61).
Eigen::VectorXd solve(const BoundedQuadratic& problem);

}  // namespace surimi
