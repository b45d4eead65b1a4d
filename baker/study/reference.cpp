// SPDX-License-Identifier: Apache-2.0
#include "baker/study/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "baker/study/shadow_rays.h"
#include "baker/study/solid_angle.h"

namespace surimi {
namespace {

constexpr size_t sets = 4;  // three degrees of freedom a texel, and each set still resolves what four times it does

class Pcg32 {
  public:
    explicit Pcg32(uint64_t key) : state_(key * multiplier + increment) { next(); }

    uint32_t next() {
        const uint64_t old = state_;
        state_ = old * multiplier + increment;
        const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<uint32_t>(old >> 59);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }
    double unit() { return next() * 0x1p-32; }

  private:
    static constexpr uint64_t multiplier = 6364136223846793005u, increment = 1442695040888963407u;
    uint64_t state_;
};

struct Sums {
    double seen = 0, all = 0;
};

Sums jittered_set(const Receiver& receiver, size_t n, Pcg32& random) {
    std::vector<uint32_t> partner(n * n);
    std::iota(partner.begin(), partner.end(), 0u);
    for (size_t i = partner.size(); i > 1; --i)
        std::swap(partner[i - 1], partner[static_cast<size_t>(random.unit() * static_cast<double>(i))]);
    ShadowRays rays(receiver.light);
    const auto side = static_cast<double>(n);
    const auto jittered = [&](size_t cell) { return (static_cast<double>(cell) + random.unit()) / side; };
    for (size_t i = 0; i < partner.size(); ++i) {
        const double u = jittered(partner[i] % n), v = jittered(partner[i] / n);
        const double s = jittered(i % n), t = jittered(i / n);
        const SurfacePoint from = receiver.surface.sample(u, v);
        const SeenMonitor monitor(receiver.light.monitor(), from.position);
        if (!(monitor.solid_angle() > 0)) continue;
        double weight = 0;
        const LightPoint to = monitor.sample(s, t, weight);
        weight *= glm::dot(normalize_or(to.position - from.position, -from.normal), from.normal);
        if (weight > 0) rays.add(from, to, weight);
    }
    const double seen = rays.seen();
    return {seen, rays.all()};
}

}  // namespace

Reference reference_visibility(const Receiver& receiver, size_t rays) {
    const auto n = std::max<size_t>(1, static_cast<size_t>(std::sqrt(static_cast<double>(rays / sets))));
    Pcg32 random(receiver.key);
    std::array<Sums, sets> parts;
    Sums sum;
    for (Sums& part : parts) {
        part = jittered_set(receiver, n, random);
        sum.seen += part.seen;
        sum.all += part.all;
    }
    if (!(sum.all > 0)) return {};
    const double visibility = sum.seen / sum.all;
    double squares = 0;  // of the deviations of seen - V all, which to first order are those of the ratio times all
    for (const Sums& part : parts) squares += std::pow(part.seen - visibility * part.all, 2);
    return {visibility, std::sqrt(squares * sets / (sets - 1.0)) / sum.all, true};
}

}  // namespace surimi
