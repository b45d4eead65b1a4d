// SPDX-License-Identifier: Apache-2.0
// Minimises a function of a few numbers without derivatives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace surimi {

template <size_t N>
struct Minimum {
    std::array<double, N> at;
    double value;
};

/// Simplex method of Nelder and Mead 1965, started from `start` and one step along each axis; ends when the values of
/// the simplex agree to `tolerance` (relative) or after `limit` evaluations. Deterministic.
template <size_t N, class F>
Minimum<N> minimize(const F& f, const std::array<double, N>& start, double step, double tolerance, int limit) {
    using Point = std::array<double, N>;
    std::array<Minimum<N>, N + 1> simplex;
    simplex[0] = {start, f(start)};
    for (size_t i = 0; i < N; ++i) {
        Point p = start;
        p[i] += step;
        simplex[i + 1] = {p, f(p)};
    }
    const auto by_value = [](const Minimum<N>& a, const Minimum<N>& b) { return a.value < b.value; };
    for (int evaluations = N + 1; evaluations < limit;) {
        std::stable_sort(simplex.begin(), simplex.end(), by_value);
        Minimum<N>& worst = simplex[N];
        if (worst.value - simplex[0].value <= tolerance * std::abs(simplex[0].value)) break;
        Point center{};
        for (size_t i = 0; i < N; ++i)
            for (size_t k = 0; k < N; ++k) center[k] += simplex[i].at[k] / static_cast<double>(N);
        const auto probe = [&](double factor) {  // on the line from the worst corner through the centre of the others
            Point p;
            for (size_t k = 0; k < N; ++k) p[k] = center[k] + factor * (worst.at[k] - center[k]);
            ++evaluations;
            return Minimum<N>{p, f(p)};
        };
        const Minimum<N> reflected = probe(-1);
        if (reflected.value < simplex[0].value) {
            const Minimum<N> expanded = probe(-2);
            worst = expanded.value < reflected.value ? expanded : reflected;
        } else if (reflected.value < simplex[N - 1].value) {
            worst = reflected;
        } else {
            const Minimum<N> contracted = probe(reflected.value < worst.value ? -0.5 : 0.5);
            if (contracted.value < std::min(worst.value, reflected.value)) {
                worst = contracted;
                continue;
            }
            for (size_t i = 1; i <= N; ++i) {
                for (size_t k = 0; k < N; ++k) simplex[i].at[k] = (simplex[i].at[k] + simplex[0].at[k]) / 2;
                simplex[i].value = f(simplex[i].at);
            }
            evaluations += static_cast<int>(N);
        }
    }
    return *std::min_element(simplex.begin(), simplex.end(), by_value);
}

}  // namespace surimi
