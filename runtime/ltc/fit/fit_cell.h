// SPDX-License-Identifier: Apache-2.0
// Fits one lobe of the table: the four numbers that bring a transformed cosine closest to GGX.
#pragma once

#include "runtime/ltc/ggx.h"
#include "runtime/ltc/lobe.h"

namespace surimi {

struct FitSettings {
    int around = 48;  ///< half-planes of the BRDF's quadrature
    int along = 72;   ///< nodes in each
    int bands = 48;   ///< nodes along and across the plane of incidence
    double stiffness =
        1e-6;            ///< price of the squared distance from the neighbours, for numbers that nothing else fixes
    double step = 0.05;  ///< first size of the simplex
    int restarts = 3;
};

/// What the fit leaves, both relative to the albedo.
struct FitError {
    double objective;        ///< (M26)
    double total_variation;  ///< half the integral of |difference|: bounds the error of every light's shape
};

/// One part of the BRDF of one cell, normalised to integral 1, on the nodes of a quadrature.
class FitCell {
  public:
    FitCell(double alpha, double cosine, const FitSettings& settings, LobePart part = LobePart::full);

    /// Error of the lobe as it is shown: cut at the true horizon and normalised again (M26). Infinite for a singular or
    /// mirrored matrix.
    FitError error(const Mat3& inverse) const;
    FitError error(const LobeShape& shape) const;

    /// Best shape by Nelder and Mead's method from `start`, drawn towards `neighbour`. At normal incidence the lobe is
    /// round, so one number is free.
    LobeShape fit(const LobeShape& start, const LobeShape& neighbour) const;

    GgxAlbedo albedo;

  private:
    double objective(const Mat3& inverse) const;

    double alpha_, cosine_;
    FitSettings settings_;
    std::vector<double> x_, y_, z_, value_, weight_;
    double norm_ = 0;
};

}  // namespace surimi
