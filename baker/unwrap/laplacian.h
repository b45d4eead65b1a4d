// SPDX-License-Identifier: Apache-2.0
// The Laplacian of a patch, factorised: for points of the plane that should have given Jacobians, and as the
// preconditioner of harder systems.
#pragma once

#include <memory>
#include <vector>

#include "baker/unwrap/patch.h"

namespace surimi {

class Laplacian {
  public:
    /// The ordering of the unknowns is found here, once. The patch has to outlive the object.
    explicit Laplacian(const Patch& patch);
    ~Laplacian();
    Laplacian(const Laplacian&) = delete;
    Laplacian& operator=(const Laplacian&) = delete;

    /// Factorises the sum over triangles of weight * area * grad(a).grad(b), vertex 0 held fast. False when it is not
    /// positive definite within rounding.
    bool factorize(const std::vector<double>& weights);

    /// x of the system whose right side is `right`, both coordinates at once; entries sum up to 0.
    void solve(const std::vector<Vec2>& right, std::vector<Vec2>& x) const;

  private:
    struct Factorisation;
    const Patch& patch_;
    std::unique_ptr<Factorisation> factorisation_;
};

}  // namespace surimi
